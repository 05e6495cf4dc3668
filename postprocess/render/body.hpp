/// The particles of one stored frame or cloud, with one field's values: what a panel shows.
#pragma once

#include "postprocess/render_job.hpp"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace tessera::post {

using Point = Eigen::Vector3f;

struct Body {
  std::vector<Point> points;     ///< m, where the particles are at that time
  std::vector<double> values;    ///< SI
  std::vector<float> radii;      ///< of the spheres that stand for the particles, m
  Eigen::AlignedBox3f reference; ///< of the undeformed body
  double spacing = 0;            ///< typical distance of neighbours before deformation, m
  bool plane = false;            ///< all points in one plane z = constant
};

/// Reads `panel.file` and its values of `field` ("Name", magnitudes of vectors, or "Name.component").
/// InputError when the file is damaged or has no such field, listing those it has.
Body read_body(const Panel& panel, const std::string& field);

/// Gives each particle's sphere half the distance to its fourth nearest other (third in the plane), but at
/// most `largest` (m): spheres of a lattice touch where that is half its spacing, and where a cloud is finer
/// they are smaller. Before that, all have one radius that lets nothing shine through.
void touch(Body& body, double largest);

/// Keeps the particles beyond the middle of the body along `axis` ("x", "y", "z") as seen along `direction`;
/// says of each that was there whether it was kept.
std::vector<bool> keep_far_half(Body& body, const std::string& axis, const Point& direction);

} // namespace tessera::post
