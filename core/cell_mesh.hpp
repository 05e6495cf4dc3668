/// Polyhedral cells of the particles, for looking at: convex pieces, several per particle where the body cuts
/// a cell.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <vector>

namespace tessera {

struct CellMesh {
  std::vector<Vec3> points; ///< m
  struct Cell {
    std::int32_t particle; ///< owner
    std::vector<std::vector<std::int32_t>>
        faces; ///< loops of point indices, counter-clockwise seen from outside
  };
  std::vector<Cell> cells;
};

} // namespace tessera
