/// fields.pvd and fields/*.vtu: the frames of a run as ParaView opens them.
#pragma once

#include "core/frame.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tessera::io {

/// Writes each frame as fields/fields_NNNN.vtu (vertices at the current positions X + Displacement, so that
/// viewers show the deformed body as it is; float32, LZ4; TimeValue as field data) and renews fields.pvd
/// after each, both atomically, so that a run killed at any moment leaves a readable series. RunError when
/// the disk refuses.
class FrameSeries {
 public:
  /// Starts an empty series in `folder` (fields of an earlier run there are removed).
  explicit FrameSeries(std::filesystem::path folder);
  void write(const Frame& frame);

 private:
  std::filesystem::path folder_;
  std::vector<std::pair<double, std::string>> entries_;
};

/// One entry of a stored series.
struct StoredFrame {
  double time = 0; ///< s
  std::filesystem::path file;
};
/// The frames fields.pvd lists, in order of time; InputError when there are none.
std::vector<StoredFrame> read_series(const std::filesystem::path& folder);

} // namespace tessera::io
