#include "preprocess/seeding/nearness.hpp"

#include <algorithm>
#include <limits>

namespace tessera::preprocess {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  return length > 0 ? Vec3(a + std::clamp((p - a).dot(along) / length, 0.0, 1.0) * along) : a;
}

Vec3 nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& X) {
  const Vec3 normal = (X[1] - X[0]).cross(X[2] - X[0]);
  bool above = true;
  for (int k = 0; k < 3; ++k)
    above &= normal.dot((X[(k + 1) % 3] - X[k]).cross(p - X[k])) >= 0;
  if (const double size = normal.squaredNorm(); above && size > 0)
    return p - normal.dot(p - X[0]) / size * normal;
  Vec3 best = X[0];
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 q = nearest_on_segment(p, X[k], X[(k + 1) % 3]);
    if ((p - q).squaredNorm() < distance) {
      distance = (p - q).squaredNorm();
      best = q;
    }
  }
  return best;
}

} // namespace tessera::preprocess
