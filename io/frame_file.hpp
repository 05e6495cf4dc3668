/// Frames of a run read back.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera::io {

/// One stored array over the particles, laid out as a Field.
struct StoredField {
  std::string name;
  int components = 1;
  std::vector<double> values; ///< particles x components, SI, as precise as float32
};

/// A frame as FrameSeries wrote it.
struct StoredFields {
  double time = 0;                 ///< s
  std::vector<Vec3> x;             ///< current positions, m
  std::vector<StoredField> fields; ///< in the file's order
};

/// InputError where the file is missing, damaged, or altered since it was written.
StoredFields read_frame(const std::filesystem::path& file);

} // namespace tessera::io
