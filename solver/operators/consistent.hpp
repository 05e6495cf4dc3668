/// Operators that balance a constant stress exactly: the correction that makes the scheme of second order.
#pragma once

#include "core/neighbours.hpp"
#include "core/tensor.hpp"
#include "solver/operators/gradient.hpp"

#include <cstdint>
#include <span>

namespace tessera::solver {

/// The smallest change of the gradient, in the weights omega, after which a constant stress P leaves the
/// force -P A_b / V_b on every particle, the one that the traction P N on its own surface A_b (m^2, outward;
/// zero inside) balances. Rows stay exact on linear fields. With Q_ab = V_a V_b g_ab that is
///   sum_a Q_ab - sum_c Q_bc = A_b   and   sum_b Q_ab (x) (X_b - X_a) = V_a I,
/// and the change is delta_ab = omega_ab (lambda_b - lambda_a - m_a . (X_b - X_a)), what the best linear fit
/// around a leaves of a field lambda, found by conjugate gradients. Returns their iterations.
///
/// Throws InputError where the areas are not balanced (sum A = 0, sum X (x) A = (sum V) I) or the iteration
/// does not converge.
template <int D>
std::int64_t balance_constant_stress(Gradient<D>& gradient, std::span<const Vec3> X, std::span<const Vec3> A,
                                     const Neighbours& neighbours);

} // namespace tessera::solver
