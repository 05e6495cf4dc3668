/// The sign of a 2-D orientation, exact, with ties broken by a consistent perturbation.
#pragma once

namespace tessera::preprocess {

struct Point2 {
  double x, y;
};

/// +1 where a, b, c turn counter-clockwise, -1 clockwise, 0 exactly in line.
int orientation(const Point2& a, const Point2& b, const Point2& c);

/// As orientation, with c moved by (e, e^2) for an infinitesimal e > 0: never 0 unless a = b. One
/// perturbation for all edges, so a point on the edge of two triangles is in exactly one of them.
int orientation_perturbed(const Point2& a, const Point2& b, const Point2& c);

} // namespace tessera::preprocess
