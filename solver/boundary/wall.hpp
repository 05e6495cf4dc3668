/// Rigid frictionless planes the body cannot pass.
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"

#include <algorithm>
#include <span>

namespace tessera::solver {

/// The half-space normal . (x - point) >= 0 is free.
template <int D>
struct Plane {
  Vec<D> point;       ///< m
  Vec<D> normal;      ///< of unit length
  double restitution; ///< 0: a particle lands on the plane and stays, 1: its normal velocity is reflected

  /// Distance to the plane, negative behind it, m.
  double gap(const Vec<D>& x) const { return normal.dot(x - point); }

  /// Limits the normal velocity of every particle that would pass the plane within dt: with restitution 0 to
  /// the velocity that just reaches it (Moreau's condition at velocity level), else to -restitution times
  /// itself. Adds the change of p (kg/(m^2 s)) times `share` to `impulse`.
  void apply(std::span<const Vec<D>> x, std::span<Vec<D>> p, double density, double dt, double share,
             std::span<Vec<D>> impulse) const {
    for_each(static_cast<std::int64_t>(x.size()), [&](std::int64_t a) {
      const double p_n = normal.dot(p[a]);
      const double reach = -density * std::max(gap(x[a]), 0.0) / dt;
      if (p_n >= reach)
        return;
      const Vec<D> change = ((restitution > 0 ? -restitution * p_n : reach) - p_n) * normal;
      p[a] += change;
      impulse[a] += share * change;
    });
  }
};

} // namespace tessera::solver
