/// A point set cut into boxes, one for each thread, and how far the circumspheres of one box reach.
#pragma once

#include "preprocess/voronoi/simplices.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace tessera::preprocess {

struct PointParts {
  std::vector<std::vector<std::int32_t>> members; ///< ascending
  std::vector<Eigen::AlignedBox3d> boxes;         ///< around them

  /// Cuts across the longest side, as evenly as `count` allows.
  PointParts(const std::vector<Vec3>& points, std::int64_t count);
};

/// Whether any point of another part can lie in the circumsphere of a tetrahedron of part `own` (for one with
/// the vertex -1: outside the hull's face, or in its circle). `unknown` where it is too flat to tell but no
/// other box comes near the tetrahedron itself. Errs on the side of `others` only.
enum class Reach { own, others, unknown };
Reach reach_of(const std::vector<Vec3>& points, const PointParts& parts, std::int64_t own, Simplex simplex);

} // namespace tessera::preprocess
