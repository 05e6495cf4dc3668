/// The shape of a body before it moved, for pictures: its tetrahedra, its surface and the lines on it.
#pragma once

#include "core/tensor.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera {

/// Indices refer to `points`. A plane body lies at z = 0 and has no solids: its faces are the body itself and
/// its edges the boundary.
struct BodyMesh {
  int dimension = 3;
  std::vector<Vec3> points; ///< m
  std::vector<std::array<std::int32_t, 4>> solids;
  std::vector<std::array<std::int32_t, 3>>
      faces; ///< counter-clockwise seen from outside, in the plane from +z
  std::vector<std::array<std::int32_t, 2>> edges; ///< where two surfaces of the CAD model meet
};

} // namespace tessera
