/// The corrected kernel gradient and its transpose as constant edge weights.
#pragma once

#include "core/neighbours.hpp"
#include "solver/operators/kernel.hpp"

#include <span>
#include <string>
#include <vector>

namespace tessera::solver {

/// Sparse operators over the neighbour graph, (3.62)-(3.66):
///   gradient    (grad f)_a = sum_b f_b (x) w_ab - f_a (x) s_a       exact for linear f
///   divergence  (div P)_a  = P_a s_a + sum_b P_b t_ab               minus the V-weighted transpose of the
///   gradient
/// with g_ab = L_a grad W_b(X_a), w_ab = V_b g_ab, t_ab = -V_b g_ba, s_a = sum_b w_ab. Weights in 1/m, edge
/// by edge in the order of Neighbours.
template <int D>
struct Gradient {
  std::vector<Vec<D>> w, t;   ///< one an edge
  std::vector<Vec<D>> s;      ///< one a particle
  double worst_condition = 0; ///< largest condition number of the moment matrices
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
