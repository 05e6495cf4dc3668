/// A moment of a run, as the solver hands it to whoever writes or draws it.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tessera {

/// One named array over the particles, `components` numbers each (1 scalar, 3 vector, 6 symmetric tensor as
/// xx, yy, zz, xy, yz, xz: ParaView's order), SI units.
struct Field {
  std::string name;
  int components = 1;
  std::span<const double> values; ///< particles x components, particle by particle
};

/// Read-only view; the arrays live in the solver and are valid during the callback only.
struct Frame {
  double time = 0; ///< s
  std::int64_t step = 0;
  std::span<const Vec3> X; ///< reference positions, m
  std::vector<Field> fields;
};

} // namespace tessera
