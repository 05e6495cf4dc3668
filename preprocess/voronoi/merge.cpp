#include "preprocess/voronoi/merge.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::preprocess {
namespace {

/// Kept points by the cube they lie in, hashed.
class Cubes {
 public:
  Cubes(std::int64_t capacity, double side) : side_(side) {
    std::size_t buckets = 16;
    while (buckets < static_cast<std::size_t>(capacity))
      buckets *= 2;
    first_.assign(buckets, -1);
  }

  void add(const Vec3& x) {
    std::int32_t& head = first_[bucket(cube(x))];
    next_.push_back(head);
    head = static_cast<std::int32_t>(next_.size()) - 1;
  }

  /// Whether test(kept) holds for any point in the cubes around x (some may lie elsewhere: hashes collide).
  template <class Test>
  bool any_near(const Vec3& x, Test&& test) const {
    const auto c = cube(x);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k)
          for (std::int32_t at = first_[bucket({c[0] + i, c[1] + j, c[2] + k})]; at >= 0; at = next_[at])
            if (test(at))
              return true;
    return false;
  }

 private:
  using Cube = std::array<std::int64_t, 3>;
  Cube cube(const Vec3& x) const {
    Cube c;
    for (int a = 0; a < 3; ++a)
      c[a] = static_cast<std::int64_t>(std::floor(x[a] / side_));
    return c;
  }
  std::size_t bucket(const Cube& c) const {
    std::uint64_t h = 0;
    for (const std::int64_t v : c) {
      h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return h & (first_.size() - 1);
  }

  double side_;
  std::vector<std::int32_t> first_, next_;
};

/// Distance `later` must keep from a kept point, as a fraction of the radius.
double claim(const CadTopology& cad, const CadPlace& kept, const CadPlace& later) {
  switch (later.dimension) {
  case 0:
    return 0;
  case 1:
    if (cad.on_curve(kept, later.entity))
      return 1;
    return kept.dimension == 1 && cad.curves_share_a_corner(kept.entity, later.entity) ? 0.8 : 0;
  case 2:
    if (cad.on_surface(kept, later.entity))
      return 1;
    return kept.dimension == 2 && cad.surfaces_share_a_curve(kept.entity, later.entity) ? 0.8 : 0;
  default:
    return 1;
  }
}

} // namespace

PlacedPoints merged(const PlacedPoints& points, const CadTopology& cad, double radius) {
  constexpr double coincident = 1e-9;
  radius = std::max(radius, coincident);
  PlacedPoints kept;
  Cubes cubes(points.size(), radius);
  for (std::int64_t i = 0; i < points.size(); ++i) {
    const Vec3& x = points.X[i];
    const CadPlace& place = points.place[i];
    const bool yields = place.dimension > 0 && cubes.any_near(x, [&](std::int32_t k) {
      const double distance = (kept.X[k] - x).norm();
      return distance < radius &&
             (distance < coincident || distance < radius * claim(cad, kept.place[k], place));
    });
    if (yields)
      continue;
    cubes.add(x);
    kept.add(x, place);
  }
  return kept;
}

} // namespace tessera::preprocess
