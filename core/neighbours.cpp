#include "core/neighbours.hpp"

#include "core/parallel.hpp"
#include "core/point_grid.hpp"

#include <algorithm>
#include <cmath>

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
  Vec3 lower = X[0], upper = X[0];
  for (const Vec3& x : X) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  // A first guess of the radius from the mean density over the directions the cloud has extent in.
  const Vec3 extent = upper - lower;
  double volume = 1;
  int dimension = 0;
  for (int i = 0; i < 3; ++i)
    if (extent[i] > 1e-9 * extent.maxCoeff()) {
      volume *= extent[i];
      ++dimension;
    }
  const double guess =
      dimension == 0 ? 1 : std::pow(volume * (k + 1) / static_cast<double>(X.size()), 1.0 / dimension);
  const PointGrid grid(X, guess);

  std::vector<double> distance(X.size());
  for_each(static_cast<std::int64_t>(X.size()), [&](std::int64_t a) {
    std::vector<double> near;
    for (double radius = guess;; radius *= 1.5) {
      near.clear();
      grid.near(X[a], radius, [&](std::int32_t b, double r) {
        if (b != a && r <= radius && !hidden.contains(a, b))
          near.push_back(r);
      });
      if (near.size() < static_cast<std::size_t>(k))
        continue;
      std::nth_element(near.begin(), near.begin() + (k - 1), near.end());
      distance[a] = near[k - 1];
      return;
    }
  });
  return distance;
}

} // namespace tessera
