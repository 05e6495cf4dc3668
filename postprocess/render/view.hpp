/// From which side a body is looked at, without perspective.
#pragma once

#include "postprocess/render/body.hpp"

#include <string>
#include <vector>

class vtkRenderer;

namespace tessera::post {

/// Orthonormal: to the right, up, and into the picture.
struct View {
  Point right, up, into;

  /// Components of a point to the right, up and into the picture.
  Point seen(const Point& p) const { return {p.dot(right), p.dot(up), p.dot(into)}; }
};

/// front (from -y), back, left, right, top (from +z), bottom or iso; InputError for other names.
View view_of(const std::string& name);

/// Of points, along right, up and into.
Eigen::AlignedBox3f extent(const View& view, const std::vector<Point>& points);

/// The eight corners of a box.
std::vector<Point> corners(const Eigen::AlignedBox3f& box);

/// Has `renderer` show what lies in `box` (along right, up, into), `height` metres of it from its lower to
/// its upper edge, lit from the upper left.
void look_at(vtkRenderer& renderer, const View& view, const Eigen::AlignedBox3f& box, double height);

/// How deep the camera sees, m: depth buffer values from 0 to 1 span it.
double depth_of(const Eigen::AlignedBox3f& box);

} // namespace tessera::post
