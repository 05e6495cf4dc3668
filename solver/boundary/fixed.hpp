/// Velocity components held at zero: clamped bases, rollers along a coordinate plane.
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera::solver {

/// Acts on one named set.
template <int D>
struct Fixed {
  std::vector<std::int32_t> particles;
  std::array<bool, 3> component; ///< x, y, z

  /// Sets the held components of p (kg/(m^2 s)) to zero.
  void apply(std::span<Vec<D>> p) const {
    for_each(static_cast<std::int64_t>(particles.size()), [&](std::int64_t i) {
      for (int c = 0; c < D; ++c)
        if (component[c])
          p[particles[i]][c] = 0;
    });
  }
};

} // namespace tessera::solver
