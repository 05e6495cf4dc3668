/// Which tetrahedron of a body holds a point.
#pragma once

#include "preprocess/geometry/domain.hpp"
#include "preprocess/seeding/box_tree.hpp"

namespace tessera::preprocess {

/// In the coordinates of `points`, one for each vertex of the domain; both outlive this. Any number of
/// threads may ask at once.
class TetLocator {
 public:
  TetLocator(const Domain& domain, const std::vector<Vec3>& points);

  /// A tetrahedron that holds x, up to rounding on its faces; -1 outside the body.
  std::int32_t locate(const Vec3& x) const;

  /// As locate; outside the body one of those nearest to x.
  std::int32_t nearest(const Vec3& x) const;

  /// Weights of a tetrahedron's corners that sum to one and give x.
  Eigen::Vector4d weights(std::int32_t tet, const Vec3& x) const;

 private:
  const Domain& domain_;
  const std::vector<Vec3>& points_;
  BoxTree tree_;
};

} // namespace tessera::preprocess
