/// The corrected kernel Laplacian as constant edge weights.
#pragma once

#include "core/neighbours.hpp"
#include "solver/operators/kernel.hpp"

#include <span>
#include <vector>

namespace tessera::solver {

/// (lap f)_a = sum_b (f_b - f_a) l_ab with l_ab = V_b (lap W + alpha_a . (X_a - X_b) + beta_a |X_a - X_b|^2),
/// (3.67)-(3.70): zero on linear f, exact on |X|^2. Weights in 1/m^2, edge by edge in the order of
/// Neighbours. Where |X|^2 is linear on a particle and its neighbours, which then lie on a sphere (the corner
/// of a lattice within supports of two spacings), no weights do both. But then every quadratic is to them a
/// linear field and a harmonic one, and the weights are zero.
struct Laplacian {
  std::vector<double> l;   ///< one an edge
  std::vector<double> sum; ///< one a particle: sum_b l_ab
  std::int64_t blind = 0;  ///< particles whose weights are zero
};

/// Throws InputError naming the particle, its neighbour count and the remedy where its neighbours do not span
/// the space.
template <int D>
Laplacian build_laplacian(std::span<const Vec3> X, std::span<const double> V, const Neighbours& neighbours,
                          const Kernel<D>& kernel = {});

/// Weights of V^-1 lap^T V, edge by edge: V_b l_ba / V_a; sums as before.
std::vector<double> transposed(const Laplacian& laplacian, std::span<const double> V,
                               const Neighbours& neighbours);

} // namespace tessera::solver
