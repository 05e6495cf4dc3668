/// From the simplices of a triangulation to the rows of a graph.
#pragma once

#include "preprocess/voronoi/delaunay.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Points of a tetrahedron, triangle or edge; -1 where there are fewer than four.
using Simplex = std::array<std::int32_t, 4>;

/// Each point's row: whoever shares a simplex with it, nearest first, ties by index. The order of the
/// simplices does not matter.
DelaunayGraph graph_of(const std::vector<Vec3>& points, const std::vector<Simplex>& simplices);

/// InputError naming two points that coincide, if any do.
void refuse_coinciding(const std::vector<Vec3>& points);

} // namespace tessera::preprocess
