/// Points sorted into cubic cells: who is near a place.
#pragma once

#include "core/tensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera {

/// Cells hold their points in ascending order, so that visits come in one order on any machine.
class PointGrid {
 public:
  /// Cells of side `cell` or, where far-apart clusters would ask for more cells than a few per point, larger.
  /// The points outlive this.
  PointGrid(std::span<const Vec3> X, double cell);

  /// Calls visit(b, distance) for every point b in the cells that the ball about x touches.
  template <class Visit>
  void near(const Vec3& x, double radius, Visit&& visit) const {
    const auto low = cell_of(x - Vec3::Constant(radius)), high = cell_of(x + Vec3::Constant(radius));
    for (std::int64_t k = low[2]; k <= high[2]; ++k)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
          const std::int64_t c = index({i, j, k});
          for (std::int64_t n = start_[c]; n < start_[c + 1]; ++n)
            visit(points_[n], (X_[points_[n]] - x).norm());
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
  std::vector<std::int32_t> points_;
};

} // namespace tessera
