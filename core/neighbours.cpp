#include "core/neighbours.hpp"

#include "core/parallel.hpp"
#include "core/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace tessera {

Neighbours find_neighbours(std::span<const Vec3> X, std::vector<double> support, const HiddenPairs& hidden) {
  const auto n = static_cast<std::int64_t>(X.size());
  const double largest = *std::max_element(support.begin(), support.end());
  const PointGrid grid(X, largest);
  const auto each_neighbour = [&](std::int64_t a, auto&& visit) {
    grid.near(X[a], largest, [&](std::int32_t b, double r) {
      if (b != a && r < std::max(support[a], support[b]) && !hidden.contains(a, b))
        visit(b);
    });
  };

  Neighbours result;
  result.row.assign(static_cast<std::size_t>(n + 1), 0);
  for_each(n, [&](std::int64_t a) {
    std::int64_t count = 0;
    each_neighbour(a, [&](std::int32_t) { ++count; });
    result.row[a + 1] = count;
  });
  for (std::int64_t a = 0; a < n; ++a)
    result.row[a + 1] += result.row[a];
  result.column.resize(static_cast<std::size_t>(result.row[n]));
  for_each(n, [&](std::int64_t a) {
    std::int64_t next = result.row[a];
    each_neighbour(a, [&](std::int32_t b) { result.column[next++] = b; });
    std::sort(result.column.begin() + result.row[a], result.column.begin() + result.row[a + 1]);
  });
  result.support = std::move(support);
  return result;
}

std::vector<double> distance_to_nearest(std::span<const Vec3> X, int k, const HiddenPairs& hidden) {
  std::vector<std::int32_t> all(X.size());
  std::iota(all.begin(), all.end(), 0);
  return distance_to_nearest(X, k, hidden, all);
}

std::vector<double> distance_to_nearest(std::span<const Vec3> X, int k, const HiddenPairs& hidden,
                                        std::span<const std::int32_t> of) {
  Vec3 lower = X[0], upper = X[0];
  for (const Vec3& x : X) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  // A first guess of the radius from the mean density over the directions the cloud has extent in: a ball of
  // half as many again as wanted.
  const Vec3 extent = upper - lower;
  double volume = 1;
  int dimension = 0;
  for (int i = 0; i < 3; ++i)
    if (extent[i] > 1e-9 * extent.maxCoeff()) {
      volume *= extent[i];
      ++dimension;
    }
  constexpr double unit_ball[] = {1, 2, std::numbers::pi, 4 * std::numbers::pi / 3};
  const double wanted = volume / unit_ball[dimension] * 1.5 * (k + 1) / static_cast<double>(X.size());
  const double guess = dimension == 0 ? 1 : std::pow(wanted, 1.0 / dimension);
  const PointGrid grid(X, guess / 2);

  std::vector<double> distance(of.size());
  for_each(static_cast<std::int64_t>(of.size()), [&](std::int64_t i) {
    thread_local std::vector<double> near;
    const std::int32_t a = of[i];
    for (double radius = guess;; radius *= 1.4) {
      near.clear();
      grid.near(X[a], radius, [&](std::int32_t b, double r) {
        if (r <= radius && b != a && !hidden.contains(a, b))
          near.push_back(r);
      });
      if (near.size() < static_cast<std::size_t>(k)) {
        if (radius < extent.norm())
          continue;
        distance[i] = std::numeric_limits<double>::infinity();
        return;
      }
      std::nth_element(near.begin(), near.begin() + (k - 1), near.end());
      distance[i] = near[k - 1];
      return;
    }
  });
  return distance;
}

} // namespace tessera
