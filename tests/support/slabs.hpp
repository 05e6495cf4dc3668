/// Plane bodies of known shape as Domains, built without any CAD kernel.
#pragma once

#include "preprocess/geometry/slab.hpp"

namespace tessera::test {

/// A figure as a slab: sides that kink by more than 30 degrees are walls of their own (edge1, edge2, ...),
/// and where walls meet there is a corner.
preprocess::Domain slab_of(preprocess::PlaneFigure figure);

/// [0, 1]^2 in n x n squares of two triangles, times `scale`, then moved. 4 walls, 4 corners.
preprocess::Domain square_slab(int n = 1, double scale = 1, const Vec<2>& offset = Vec<2>::Zero());

/// [0, 2]^2 minus [1, 2]^2, n squares a unit. Area 3 scale^2, 6 walls, 6 corners.
preprocess::Domain l_slab(int n = 1, double scale = 1, const Vec<2>& offset = Vec<2>::Zero());

/// [0, 1]^2 with a hole of radius 0.3 in its middle, a regular polygon of 8 n corners that counts as smooth
/// (n >= 2): area scale^2 (1 - 4 n 0.09 sin(pi / (4 n))), 5 walls, 4 corners.
preprocess::Domain holed_slab(int n, double scale = 1, const Vec<2>& offset = Vec<2>::Zero());

/// Two squares [0, 1]^2 and [1 + width, 2 + width] x [0, 1] joined by a foot of height 0.2 below (y from -0.2
/// to 0): a slot of the given width between them. Area 2 + 0.2 (2 + width), n squares a unit.
preprocess::Domain slotted_slab(int n, double width);

} // namespace tessera::test
