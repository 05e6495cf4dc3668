#include "core/point_grid.hpp"

#include <limits>

namespace tessera {

PointGrid::PointGrid(std::span<const Vec3> X, double cell) : X_(X), cell_(cell) {
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
  points_.resize(X.size());
  std::vector<std::int64_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < X.size(); ++i)
    points_[next[home[i]]++] = static_cast<std::int32_t>(i);
}

} // namespace tessera
