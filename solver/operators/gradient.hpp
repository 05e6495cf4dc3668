/// The corrected kernel gradient and its transpose, factored into one number a pair and a few a particle.
#pragma once

#include "core/lanes.hpp"
#include "core/neighbours.hpp"
#include "solver/operators/kernel.hpp"

#include <span>
#include <string>
#include <vector>

namespace tessera::solver {

/// Sparse operators over the neighbour graph, (3.62)-(3.66):
///   gradient    (grad f)_a = sum_b (f_b - f_a) (x) w_ab             exact for linear f
///   divergence  (div P)_a  = sum_b (P_a w_ab + P_b t_ab)            minus the V-weighted transpose
/// with V_a t_ab = -V_b w_ba. All weights (1/m) come from one symmetric number a pair, omega_ab = V_a V_b
/// |W'|/r,
///   w_ab = omega_ab / V_a (B_a (X_b - X_a) + lambda_b - lambda_a)
///   t_ab = omega_ab / V_a (B_b (X_b - X_a) + lambda_b - lambda_a),
/// B_a = V_a M_a^-1 with the moments M_a = sum_b omega_ab (X_b - X_a) (x) (X_b - X_a), lambda = 0 until
/// balance_constant_stress() changes both. Eight bytes a pair are read in a sweep where the weights
/// themselves would be 56. Any symmetric positive omega makes operators as exact: it is rounded to 32 bits
/// before anything is made from it.
template <int D>
struct Gradient {
  using Anchor = Lanes<D, 2>; ///< X, m | lambda, m

  std::vector<float> omega;           ///< m^(2 D - D - 2), one an edge in the order of Neighbours
  std::vector<Anchor> anchor;         ///< one a particle
  std::vector<Mat<D>> B;              ///< -
  std::vector<Mat<D>> inverse_moment; ///< M^-1
  std::vector<double> V;              ///< subvolumes, m^D
  double worst_condition = 0;         ///< largest condition number of the moments

  /// omega_ab (X_b - X_a | lambda_b - lambda_a) of edge e from a to b.
  Anchor reach(std::int64_t a, std::int64_t e, std::int32_t b) const {
    return static_cast<double>(omega[e]) * (anchor[b] - anchor[a]);
  }
  Vec<D> w(std::int64_t a, std::int64_t e, std::int32_t b) const { return weight(a, e, b, B[a]); }
  Vec<D> t(std::int64_t a, std::int64_t e, std::int32_t b) const { return weight(a, e, b, B[b]); }

 private:
  Vec<D> weight(std::int64_t a, std::int64_t e, std::int32_t b, const Mat<D>& of) const {
    const Anchor d = reach(a, e, b);
    return (of * d.col(0).template head<D>() + d.col(1).template head<D>()) / V[a];
  }
};

/// Throws InputError naming the particle, its neighbour count and the remedy where a moment matrix is
/// singular.
template <int D>
Gradient<D> build_gradient(std::span<const Vec3> X, std::span<const double> V, const Neighbours& neighbours,
                           const Kernel<D>& kernel = {});

/// Beyond this condition number of a moment matrix the correction amplifies round-off and irregularity more
/// than it corrects.
constexpr double singular = 1e8;

/// Condition number of a symmetric moment matrix; infinite when it is singular.
template <int D>
double condition_number(const Mat<D>& moment);

/// Moment matrix of particle a, sum_b V_b |W'|/r (X_b - X_a) (x) (X_b - X_a), (3.64): the inverse of L_a.
template <int D>
Mat<D> moment_matrix(std::int64_t a, std::span<const Vec3> X, std::span<const double> V,
                     const Neighbours& neighbours, const Kernel<D>& kernel = {});

} // namespace tessera::solver
