/// Bodies of known shape as Domains, built without any CAD kernel.
#pragma once

#include "preprocess/geometry/domain.hpp"

namespace tessera::test {

/// Block between two corners, n cells a side, six tetrahedra a cell. Surfaces xmin, xmax, ymin, ymax, zmin,
/// zmax (each a group too), 12 curves, 8 corners.
preprocess::Domain box_domain(const Vec3& lower = Vec3::Zero(), const Vec3& upper = Vec3::Ones(), int n = 1);

/// L-shaped block: ([0,2]^2 minus [1,2]^2) x [0,1], n cells per unit, times `scale`, then moved by `offset`.
/// Volume 3 scale^3. Surfaces as the box's, with `notch_x` (x = 1) and `notch_y` (y = 1) meeting in the
/// re-entrant curve x = y = 1: 8 surfaces, 18 curves, 12 corners.
preprocess::Domain l_domain(int n = 1, double scale = 1, const Vec3& offset = Vec3::Zero());

/// [0, 1]^2 x [0, 0.5] with a bore of radius 0.3 along z in its middle, a regular prism of 8 n sides that
/// counts as one smooth surface: n rings and n layers of cells. 7 surfaces, 14 curves, 8 corners, volume (1 -
/// 4 n 0.09 sin(pi / (4 n))) / 2.
preprocess::Domain holed_domain(int n);

/// Two unit cubes [0, 1]^3 and [1 + width, 2 + width] x [0, 1]^2 joined by a foot of height 0.2 (y from -0.2
/// to 0), all times `scale`: a slot of the given width between them. Volume (2 + 0.2 (2 + width)) scale^3.
preprocess::Domain slotted_domain(int n, double width, double scale = 1);

} // namespace tessera::test
