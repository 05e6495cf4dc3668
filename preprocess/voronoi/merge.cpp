#include "preprocess/voronoi/merge.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

constexpr double coincident = 1e-9;

} // namespace

double claim(const CadTopology& cad, int dimension, const CadPlace& kept, const CadPlace& later) {
  if (later.dimension == dimension)
    return 1;
  switch (later.dimension) {
  case 0:
    return 0;
  case 1:
    if (cad.on_curve(kept, later.entity))
      return 1;
    return kept.dimension == 1 && cad.curves_share_a_corner(kept.entity, later.entity) ? 0.8 : 0;
  default:
    if (cad.on_surface(kept, later.entity))
      return 1;
    return kept.dimension == 2 && cad.surfaces_share_a_curve(kept.entity, later.entity) ? 0.8 : 0;
  }
}

KeptPoints::KeptPoints(const CadTopology& cad, int dimension, double smallest, double largest)
    : cad_(&cad), dimension_(dimension) {
  for (double side = std::max(smallest, coincident);; side *= 2) {
    grids_.push_back({side, std::vector<std::int32_t>(16, -1), {}});
    if (side >= largest)
      break;
  }
}

KeptPoints::Cube KeptPoints::cube(const Grid& grid, const Vec3& x) {
  Cube c;
  for (int a = 0; a < 3; ++a)
    c[a] = static_cast<std::int64_t>(std::floor(x[a] / grid.side));
  return c;
}

std::size_t KeptPoints::bucket(const Grid& grid, const Cube& c) {
  std::uint64_t h = 0;
  for (const std::int64_t v : c) {
    h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u;
    h ^= h >> 29;
  }
  return h & (grid.first.size() - 1);
}

void KeptPoints::insert(Grid& grid, std::int32_t point) const {
  std::int32_t& head = grid.first[bucket(grid, cube(grid, points_.X[point]))];
  grid.next[point] = head;
  head = point;
}

void KeptPoints::rehash(Grid& grid) const {
  grid.first.assign(4 * grid.first.size(), -1);
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(grid.next.size()); ++k)
    insert(grid, k);
}

void KeptPoints::add(const Vec3& x, const CadPlace& place) {
  points_.add(x, place);
  for (Grid& grid : grids_) {
    grid.next.push_back(-1);
    if (grid.next.size() > grid.first.size())
      rehash(grid);
    else
      insert(grid, static_cast<std::int32_t>(grid.next.size()) - 1);
  }
}

const KeptPoints::Grid& KeptPoints::grid_for(double reach) const {
  const auto wide_enough = [&](const Grid& grid) { return grid.side >= reach; };
  const auto at = std::find_if(grids_.begin(), grids_.end(), wide_enough);
  return at == grids_.end() ? grids_.back() : *at;
}

/// Whether test(point) holds for any point in the cubes around x (some may lie elsewhere: hashes collide).
template <class Test>
bool KeptPoints::any_near(const Vec3& x, double reach, Test&& test) const {
  const Grid& grid = grid_for(reach);
  const Vec3 out = Vec3::Constant(reach);
  const Cube low = cube(grid, x - out), high = cube(grid, x + out);
  for (std::int64_t i = low[0]; i <= high[0]; ++i)
    for (std::int64_t j = low[1]; j <= high[1]; ++j)
      for (std::int64_t k = low[2]; k <= high[2]; ++k)
        for (std::int32_t at = grid.first[bucket(grid, {i, j, k})]; at >= 0; at = grid.next[at])
          if (test(at))
            return true;
  return false;
}

bool KeptPoints::has_room(const Vec3& x, const CadPlace& place, double radius) const {
  return place.dimension == 0 || !any_near(x, std::max(radius, coincident), [&](std::int32_t k) {
           const double distance = (points_.X[k] - x).norm();
           return distance < coincident ||
                  (distance < radius &&
                   distance < radius * claim(*cad_, dimension_, points_.place[k], place));
         });
}

void KeptPoints::collect(const Vec3& x, double reach, std::vector<std::int32_t>& found) const {
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  any_near(x, reach, [&](std::int32_t k) {
    if ((points_.X[k] - x).squaredNorm() < reach * reach)
      found.push_back(k);
    return false;
  });
  // Two cubes in one bucket give its points twice.
  std::sort(found.begin() + before, found.end());
  found.erase(std::unique(found.begin() + before, found.end()), found.end());
}

PlacedPoints merged(const PlacedPoints& points, const CadTopology& cad, double radius, int dimension) {
  return merged(points, cad, std::vector<double>(points.X.size(), radius), dimension);
}

PlacedPoints merged(const PlacedPoints& points, const CadTopology& cad, const std::vector<double>& radii,
                    int dimension) {
  if (radii.empty())
    return points;
  const auto [smallest, largest] = std::minmax_element(radii.begin(), radii.end());
  KeptPoints kept(cad, dimension, *smallest, *largest);
  for (std::int64_t i = 0; i < points.size(); ++i)
    if (kept.has_room(points.X[i], points.place[i], radii[i]))
      kept.add(points.X[i], points.place[i]);
  return kept.take();
}

} // namespace tessera::preprocess
