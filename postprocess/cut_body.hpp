/// What of a body's mesh lies beyond a plane across an axis, with the face the cut leaves.
#pragma once

#include "core/body_mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera::post {

/// The plane x[axis] = at; what lies on `side` (1 or -1) of it stays.
struct CutPlane {
  int axis = 0;
  double at = 0; ///< m
  double side = 1;

  /// Distance from the plane, positive where the body stays, m.
  double beyond(const Vec3& x) const { return side * (x[axis] - at); }
};

/// Surfaces and lines to be drawn. Indices refer to `points`.
struct CutBody {
  using Polygon = std::vector<std::int32_t>;
  std::vector<Vec3> points;   ///< m
  std::vector<double> values; ///< one a point, or none
  std::vector<Polygon> skin;
  std::vector<Polygon> section;                   ///< the cut's face, through the solids
  std::vector<std::array<std::int32_t, 2>> edges; ///< what stays of the body's
  std::vector<std::array<std::int32_t, 2>> rim;   ///< of the section: the cut through the faces
};

/// `values`: one a point of `mesh`, or none; linear along its edges.
CutBody cut_body(const BodyMesh& mesh, std::span<const double> values, const CutPlane& plane);

/// The whole of it.
CutBody whole_body(const BodyMesh& mesh, std::span<const double> values);

} // namespace tessera::post
