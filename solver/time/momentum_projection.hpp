/// The smallest correction of the nodal forces that makes them self-equilibrated, (3.111)-(3.116).
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"

#include <span>

namespace tessera::solver {

/// Adds lambda + omega x (Gamma_a - centre) to every R_a so that sum V R = 0 and sum V Gamma x R = 0. With
/// Gamma = x^n in stage 1 and Gamma = x^(n+1) = x^n + dt/(2 rho) (p^n + p*) in stage 2 of Heun's method,
/// total linear and angular momentum are constant to round-off. R in N/m^3, Gamma in m, V in m^3.
///
/// Moments are taken about the centre of volume, where the 6x6 system (3x3 in the plane) falls into two
/// blocks.
template <int D>
void project_momentum(std::span<Vec<D>> R, std::span<const Vec<D>> Gamma, std::span<const double> V) {
  const auto n = static_cast<std::int64_t>(R.size());
  const double volume = sum(n, 0.0, [&](std::int64_t a) { return V[a]; });
  const Vec<D> centre =
      sum(n, Vec<D>(Vec<D>::Zero()), [&](std::int64_t a) -> Vec<D> { return V[a] * Gamma[a]; }) / volume;
  const Vec<D> lambda =
      -sum(n, Vec<D>(Vec<D>::Zero()), [&](std::int64_t a) -> Vec<D> { return V[a] * R[a]; }) / volume;

  if constexpr (D == 3) {
    using Sums = Eigen::Matrix<double, 3, 4>; // moment of R | inertia
    const Sums sums = sum(n, Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
      const Vec3 arm = Gamma[a] - centre;
      Sums s;
      s.col(0) = V[a] * arm.cross(R[a]);
      s.template rightCols<3>() = V[a] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
      return s;
    });
    const Mat3 inertia = sums.template rightCols<3>();
    const Vec3 moment = sums.col(0);
    const Vec3 omega = -inertia.ldlt().solve(moment);
    for_each(n, [&](std::int64_t a) { R[a] += lambda + omega.cross(Gamma[a] - centre); });
  } else {
    using Sums = Eigen::Vector2d; // moment of R, inertia
    const Sums sums = sum(n, Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
      const Vec<2> arm = Gamma[a] - centre;
      return V[a] * Sums(arm[0] * R[a][1] - arm[1] * R[a][0], arm.squaredNorm());
    });
    const double omega = -sums[0] / sums[1];
    for_each(n, [&](std::int64_t a) {
      const Vec<2> arm = Gamma[a] - centre;
      R[a] += lambda + omega * Vec<2>(-arm[1], arm[0]);
    });
  }
}

/// Takes the mean of the dissipation D^J (1/s, already part of R) off the rates R of the volume map, so that
/// it keeps sum V J, (3.120).
inline void project_volume(std::span<double> R, std::span<const double> D_J, std::span<const double> V) {
  const auto n = static_cast<std::int64_t>(R.size());
  const Eigen::Vector2d sums = sum(n, Eigen::Vector2d(0, 0), [&](std::int64_t a) -> Eigen::Vector2d {
    return V[a] * Eigen::Vector2d(D_J[a], 1);
  });
  for_each(n, [&](std::int64_t a) { R[a] -= sums[0] / sums[1]; });
}

} // namespace tessera::solver
