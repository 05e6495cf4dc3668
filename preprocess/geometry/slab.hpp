/// Plane figures, and the slabs of unit thickness they are as Domains.
#pragma once

#include "preprocess/geometry/domain.hpp"
#include "preprocess/geometry/triangles.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tessera::preprocess {

/// A triangulated figure in the plane.
struct PlaneFigure {
  /// Piece of the boundary, the figure on its left.
  struct Side {
    std::array<std::int32_t, 2> vertices;
    std::int32_t curve; ///< index into `curves`, -1 while unknown
  };
  std::vector<Vec<2>> vertices; ///< all of them used by triangles
  std::vector<Triangle> triangles;
  std::vector<Side> sides;
  std::vector<std::string> curves; ///< names of the boundary's curves
};

/// Turns all triangles counter-clockwise and fills `sides` with what belongs to one triangle only, in the
/// order of the triangles, of no curve yet. Throws InputError naming `origin`: a triangle without area, an
/// edge with more than two triangles, two triangles that lie on each other (on the same side of their edge).
void find_sides(PlaneFigure& figure, const std::string& origin);

/// For figures that come without curves: sides that meet with a kink of less than `degrees` become one curve.
/// Names the curves edge1, edge2, ... by first appearance.
void curves_by_angle(PlaneFigure& figure, double degrees);

/// The slab: vertex v of the figure is vertex v on the upper lid, v + vertices.size() on the lower. Each
/// prism becomes three tetrahedra, its walls' diagonals running from the upper end of the lower-numbered
/// vertex, so that neighbours match. Has walls, lids, the upper rim as feature edges, volume and box; corners
/// and groups are left to the caller.
Domain draw_out(const PlaneFigure& figure);

} // namespace tessera::preprocess
