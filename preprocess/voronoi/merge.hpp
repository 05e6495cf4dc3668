/// Points nearer to each other than a radius become one, CAD model respected.
#pragma once

#include "preprocess/voronoi/vertices.hpp"

namespace tessera::preprocess {

/// Keeps greedily, in the given order (lower dimensions first), each point that has no kept point nearer than
/// `radius`. Corners always stay. A point of a curve yields to its corners and to points of the same curve,
/// one of a surface to that surface's corners, curves and points, an inner one to all. Beyond that, points of
/// two curves that share a corner and of two surfaces that share a curve keep 0.8 radius between them; the
/// two sides of a thin plate or slot never merge. Points closer than 1e-9 always do, unless both are corners.
PlacedPoints merged(const PlacedPoints& points, const CadTopology& cad, double radius);

} // namespace tessera::preprocess
