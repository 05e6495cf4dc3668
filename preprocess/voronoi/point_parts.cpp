#include "preprocess/voronoi/point_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace tessera::preprocess {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Box box_around(const std::vector<Vec3>& points, std::span<const std::int32_t> chosen) {
  Box box;
  for (const std::int32_t i : chosen)
    box.extend(points[i]);
  return box;
}

template <class Test>
bool any_other(const PointParts& parts, std::int64_t own, Test&& test) {
  for (std::int64_t p = 0; p < static_cast<std::int64_t>(parts.boxes.size()); ++p)
    if (p != own && test(parts.boxes[p]))
      return true;
  return false;
}

bool ball_meets(const Vec3& centre, double radius, const Box& box) {
  // A hair more than the rounding of the centre's and the box's coordinates.
  const double slack = 16 * epsilon *
                       (centre.cwiseAbs().maxCoeff() + box.min().cwiseAbs().maxCoeff() +
                        box.max().cwiseAbs().maxCoeff() + radius);
  return !(box.squaredExteriorDistance(centre) > (radius + slack) * (radius + slack));
}

/// Circumsphere of the origin, a, b, c: centre, and a radius that covers its rounding. False: too flat.
bool circumsphere(const Vec3& a, const Vec3& b, const Vec3& c, Vec3& centre, double& radius) {
  const double longest = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
  const double cube = longest * longest * longest;
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double sixfold = a.dot(bc);
  if (!(std::abs(sixfold) > 1e-10 * cube))
    return false;
  centre = (a.squaredNorm() * bc + b.squaredNorm() * ca + c.squaredNorm() * ab) / (2 * sixfold);
  const double offset = centre.norm();
  radius = offset + 64 * epsilon * cube * (longest + offset) / std::abs(sixfold);
  return true;
}

/// Of a face of the hull, the body's side behind it: whether the box may hold points outside.
bool hull_face_sees(const Vec3& a, const Vec3& b, const Vec3& c, const Box& box) {
  const Vec3 ab = b - a, ac = c - a, normal = ab.cross(ac);
  const double longest = std::sqrt(std::max(ab.squaredNorm(), ac.squaredNorm()));
  if (!(normal.norm() > 1e-10 * longest * longest))
    return true;
  // Rounding cannot tell on which side of an oblique face a near corner lies; of a face in a coordinate plane
  // it can.
  const bool upright = ((ab.array() == 0) && (ac.array() == 0)).any();
  bool touches = false;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 to = box.corner(static_cast<Box::CornerType>(corner)) - a;
    const double height = normal.dot(to), slack = 64 * epsilon * longest * longest * to.norm();
    if (upright ? height > 0 : height > -slack)
      return true;
    touches |= height == 0;
  }
  if (!touches)
    return false;
  const Vec3 centre = (ab.squaredNorm() * ac.cross(normal) + ac.squaredNorm() * normal.cross(ab)) /
                      (2 * normal.squaredNorm());
  return ball_meets(a + centre, centre.norm() * (1 + 1e-6), box);
}

} // namespace

PointParts::PointParts(const std::vector<Vec3>& points, std::int64_t count) {
  std::vector<std::int32_t> all(points.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = static_cast<std::int32_t>(i);
  const auto cut = [&](auto&& self, std::span<std::int32_t> some, std::int64_t pieces) -> void {
    if (pieces == 1) {
      members.emplace_back(some.begin(), some.end());
      std::sort(members.back().begin(), members.back().end());
      boxes.push_back(box_around(points, some));
      return;
    }
    int axis = 0;
    box_around(points, some).sizes().maxCoeff(&axis);
    const std::int64_t lower = pieces / 2;
    const auto middle = some.size() * static_cast<std::size_t>(lower) / static_cast<std::size_t>(pieces);
    std::nth_element(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(middle), some.end(),
                     [&](std::int32_t i, std::int32_t j) {
                       return points[i][axis] != points[j][axis] ? points[i][axis] < points[j][axis] : i < j;
                     });
    self(self, some.first(middle), lower);
    self(self, some.subspan(middle), pieces - lower);
  };
  cut(cut, all, count);
}

Reach reach_of(const std::vector<Vec3>& points, const PointParts& parts, std::int64_t own, Simplex simplex) {
  const auto at = std::find(simplex.begin(), simplex.end(), -1);
  if (at != simplex.end()) {
    // The infinite vertex put first by an even permutation: the others then face the hull's inside.
    const auto k = at - simplex.begin();
    std::swap(simplex[0], simplex[k]);
    if (k != 0)
      std::swap(simplex[2], simplex[3]);
    const Vec3 &a = points[simplex[1]], &b = points[simplex[3]], &c = points[simplex[2]];
    return any_other(parts, own, [&](const Box& box) { return hull_face_sees(a, b, c, box); }) ? Reach::others
                                                                                               : Reach::own;
  }
  const Vec3& origin = points[simplex[0]];
  Vec3 centre;
  double radius;
  if (circumsphere(points[simplex[1]] - origin, points[simplex[2]] - origin, points[simplex[3]] - origin,
                   centre, radius))
    return any_other(parts, own, [&](const Box& box) { return ball_meets(origin + centre, radius, box); })
               ? Reach::others
               : Reach::own;
  const Box itself = box_around(points, simplex);
  return any_other(parts, own, [&](const Box& box) { return !itself.intersection(box).isEmpty(); })
             ? Reach::others
             : Reach::unknown;
}

} // namespace tessera::preprocess
