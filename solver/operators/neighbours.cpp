#include "solver/operators/neighbours.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tessera::solver {
namespace {

/// Particles sorted into cubic cells; cells hold their particles in ascending order.
class CellGrid {
 public:
  CellGrid(std::span<const Vec3> X, double cell) : X_(X), cell_(cell) {
    lower_ = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 upper = -lower_;
    for (const Vec3& x : X) {
      lower_ = lower_.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
    // Far-apart clusters must not ask for more cells than a few per particle.
    const auto most = static_cast<double>(4 * X.size() + 64);
    const auto cells_at = [&](double size) {
      double product = 1;
      for (int i = 0; i < 3; ++i)
        product *= std::floor((upper[i] - lower_[i]) / size) + 1;
      return product;
    };
    while (cells_at(cell_) > most)
      cell_ *= 1.26;
    for (int i = 0; i < 3; ++i)
      cells_[i] = static_cast<std::int64_t>((upper[i] - lower_[i]) / cell_) + 1;
    start_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2] + 1), 0);
    std::vector<std::int64_t> home(X.size());
    for (std::size_t i = 0; i < X.size(); ++i) {
      home[i] = index(cell_of(X[i]));
      ++start_[home[i] + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c)
      start_[c] += start_[c - 1];
    particles_.resize(X.size());
    std::vector<std::int64_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < X.size(); ++i)
      particles_[next[home[i]]++] = static_cast<std::int32_t>(i);
  }

  /// Calls visit(b, distance) for every particle b in the cells that the ball about x touches.
  template <class Visit>
  void near(const Vec3& x, double radius, Visit&& visit) const {
    const auto low = cell_of(x - Vec3::Constant(radius)), high = cell_of(x + Vec3::Constant(radius));
    for (std::int64_t k = low[2]; k <= high[2]; ++k)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
          const std::int64_t c = index({i, j, k});
          for (std::int64_t n = start_[c]; n < start_[c + 1]; ++n)
            visit(particles_[n], (X_[particles_[n]] - x).norm());
        }
  }

 private:
  using Index = std::array<std::int64_t, 3>;
  Index cell_of(const Vec3& x) const {
    Index c;
    for (int i = 0; i < 3; ++i)
      c[i] = std::clamp(static_cast<std::int64_t>(std::floor((x[i] - lower_[i]) / cell_)), std::int64_t{0},
                        cells_[i] - 1);
    return c;
  }
  std::int64_t index(const Index& c) const { return (c[2] * cells_[1] + c[1]) * cells_[0] + c[0]; }

  std::span<const Vec3> X_;
  double cell_;
  Vec3 lower_;
  Index cells_{};
  std::vector<std::int64_t> start_;
  std::vector<std::int32_t> particles_;
};

} // namespace

Neighbours find_neighbours(std::span<const Vec3> X, std::vector<double> support) {
  const auto n = static_cast<std::int64_t>(X.size());
  const double largest = *std::max_element(support.begin(), support.end());
  const CellGrid grid(X, largest);
  const auto each_neighbour = [&](std::int64_t a, auto&& visit) {
    grid.near(X[a], largest, [&](std::int32_t b, double r) {
      if (b != a && r < std::max(support[a], support[b]))
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

std::vector<double> distance_to_nearest(std::span<const Vec3> X, int k) {
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
  const CellGrid grid(X, guess);

  std::vector<double> distance(X.size());
  for_each(static_cast<std::int64_t>(X.size()), [&](std::int64_t a) {
    std::vector<double> near;
    for (double radius = guess;; radius *= 1.5) {
      near.clear();
      grid.near(X[a], radius, [&](std::int32_t b, double r) {
        if (b != a && r <= radius)
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

} // namespace tessera::solver
