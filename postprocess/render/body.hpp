/// The particles of one stored frame or cloud, with one field's values: what a panel shows.
#pragma once

#include "postprocess/cut_body.hpp"
#include "postprocess/render_job.hpp"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace tessera::post {

using Point = Eigen::Vector3f;

struct Body {
  std::vector<Point> points;      ///< m, where the particles are at that time, displacements magnified
  std::vector<double> values;     ///< SI
  std::vector<float> radii;       ///< of the spheres that stand for the particles, m
  std::vector<Vec3> displacement; ///< m, magnified
  /// How much stress there is, Pa, for fields that mean nothing without; empty with others.
  std::vector<double> stress;
  Eigen::AlignedBox3f reference; ///< of the undeformed body
  double spacing = 0;            ///< typical distance of neighbours before deformation, m
  bool plane = false;            ///< all points in one plane z = constant
};

/// Reads `panel.file` and its values of `field` ("Name", magnitudes of vectors, or "Name.component").
/// InputError when the file is damaged or has no such field, listing those it has.
Body read_body(const Panel& panel, const std::string& field);

/// Takes the values where there is next to no stress, and direction and kind of it are chance: less than a
/// hundredth of the largest of all bodies.
void mask_unstressed(std::vector<Body>& bodies);

/// Gives each particle's sphere half the distance to its fourth nearest other (third in the plane), but at
/// most `largest` (m): spheres of a lattice touch where that is half its spacing, and where a cloud is finer
/// they are smaller. Before that, all have one radius that lets nothing shine through.
void touch(Body& body, double largest);

/// The plane that leaves the far part of a body as seen along `direction`: across panel.clip at
/// panel.clip_at, else in the middle of `box`.
CutPlane cut_plane(const Panel& panel, const Eigen::AlignedBox3f& box, const Point& direction);

/// Keeps the particles beyond a plane; says of each that was there whether it was kept. InputError where none
/// is.
std::vector<bool> keep_beyond(Body& body, const CutPlane& plane);

/// What the particles' centres span.
Eigen::AlignedBox3f span_of(const Body& body);

} // namespace tessera::post
