#include "preprocess/seeding/tet_locator.hpp"

namespace tessera::preprocess {
namespace {

std::vector<Box> boxes_of(const Domain& domain, const std::vector<Vec3>& points) {
  std::vector<Box> boxes;
  boxes.reserve(domain.tets.size());
  for (const auto& tet : domain.tets) {
    Box box{points[tet[0]], points[tet[0]]};
    for (const std::int32_t v : tet) {
      box.lower = box.lower.cwiseMin(points[v]);
      box.upper = box.upper.cwiseMax(points[v]);
    }
    boxes.push_back(box);
  }
  return boxes;
}

} // namespace

TetLocator::TetLocator(const Domain& domain, const std::vector<Vec3>& points)
    : domain_(domain), points_(points), tree_(boxes_of(domain, points)) {}

std::int32_t TetLocator::locate(const Vec3& x) const {
  constexpr double slack = 1e-12; // of a tetrahedron: a point on a face is in both
  return tree_.find({x, x}, [&](std::int32_t t) { return (weights(t, x).array() >= -slack).all(); });
}

std::int32_t TetLocator::nearest(const Vec3& x) const {
  const std::int32_t t = locate(x);
  if (t >= 0)
    return t;
  // How far outside a tetrahedron x lies, by its corners' weights: good enough to carry a field over the
  // edge.
  return tree_
      .nearest(x,
               [&](std::int32_t k) {
                 const Eigen::Vector4d w = weights(k, x).cwiseMax(0);
                 Vec3 inside = Vec3::Zero();
                 for (int c = 0; c < 4; ++c)
                   inside += w[c] / w.sum() * points_[domain_.tets[k][c]];
                 return (x - inside).squaredNorm();
               })
      .first;
}

Eigen::Vector4d TetLocator::weights(std::int32_t t, const Vec3& x) const {
  const auto& tet = domain_.tets[t];
  const Vec3 a = points_[tet[0]] - x, b = points_[tet[1]] - x, c = points_[tet[2]] - x,
             d = points_[tet[3]] - x;
  const Eigen::Vector4d parts(b.dot(c.cross(d)), -a.dot(c.cross(d)), a.dot(b.cross(d)), -a.dot(b.cross(c)));
  const double whole = (b - a).dot((c - a).cross(d - a));
  return parts / whole;
}

} // namespace tessera::preprocess
