/// Who shares a Voronoi face with whom: the Delaunay graph of a point set.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::preprocess {

/// Neighbours of each point in compressed rows, nearest first (ties by index): a superset of the points whose
/// cells share a face with its cell, whichever triangulation a degenerate set (a lattice) gets.
struct DelaunayGraph {
  std::vector<std::int64_t> rows;    ///< points + 1
  std::vector<std::int32_t> columns; ///< neighbour indices

  std::span<const std::int32_t> of(std::int64_t i) const {
    const auto at = static_cast<std::size_t>(i);
    return {columns.data() + rows[at], static_cast<std::size_t>(rows[at + 1] - rows[at])};
  }
};

/// The graph of `points` (any number, also all in one plane or line), the same on any number of threads.
/// InputError where two points coincide.
///
/// Each thread triangulates a box of the points. Tetrahedra whose circumspheres no other box reaches belong
/// to the whole triangulation; the points of all others are triangulated once more, which closes the gap
/// between (a few layers of points along the cuts and the hull).
DelaunayGraph delaunay_graph(const std::vector<Vec3>& points);

} // namespace tessera::preprocess
