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
/// blocks. One pass over the particles finds all sums, with arms from the first of them.
template <int D>
void project_momentum(std::span<Vec<D>> R, std::span<const Vec<D>> Gamma, std::span<const double> V) {
  const auto n = static_cast<std::int64_t>(R.size());
  const Vec<D> first = Gamma[0];
  using Sums = Eigen::Matrix<double, 2 * D + 2, D + 1>; // of V (arm, 1, R, 0) (x) (arm, 1)
  const Sums sums = sum(n, Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
    Eigen::Matrix<double, 2 * D + 2, 1> left;
    left << Gamma[a] - first, 1, R[a], 0;
    return V[a] * left * left.template head<D + 1>().transpose();
  });
  const double volume = sums(D, D);
  const Vec<D> centre = sums.template block<D, 1>(0, D) / volume;
  const Vec<D> force = sums.template block<D, 1>(D + 1, D);
  const Vec<D> lambda = -force / volume;
  const Mat<D> second = sums.template topLeftCorner<D, D>() - volume * centre * centre.transpose();
  const Mat<D> moment = sums.template block<D, D>(D + 1, 0) - force * centre.transpose(); // V R (x) arm
  const Vec<D> about = first + centre;

  if constexpr (D == 3) {
    const Mat3 inertia = second.trace() * Mat3::Identity() - second;
    const Vec3 torque(moment(2, 1) - moment(1, 2), moment(0, 2) - moment(2, 0), moment(1, 0) - moment(0, 1));
    const Vec3 omega = -inertia.ldlt().solve(torque);
    for_each(n, [&](std::int64_t a) { R[a] += lambda + omega.cross(Gamma[a] - about); });
  } else {
    const double omega = -(moment(1, 0) - moment(0, 1)) / second.trace();
    for_each(n, [&](std::int64_t a) {
      const Vec<D> arm = Gamma[a] - about;
      R[a] += lambda + omega * Vec<2>(-arm[1], arm[0]);
    });
  }
}

/// Takes the mean off the dissipation D^J (1/s) of the volume map, so that it keeps sum V J, (3.120).
inline void project_volume(std::span<double> D_J, std::span<const double> V) {
  const auto n = static_cast<std::int64_t>(D_J.size());
  const Eigen::Vector2d sums = sum(n, Eigen::Vector2d(0, 0), [&](std::int64_t a) -> Eigen::Vector2d {
    return V[a] * Eigen::Vector2d(D_J[a], 1);
  });
  for_each(n, [&](std::int64_t a) { D_J[a] -= sums[0] / sums[1]; });
}

} // namespace tessera::solver
