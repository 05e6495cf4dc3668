/// Particle values at any point of the body: the corrected kernel.
#pragma once

#include "core/hidden_pairs.hpp"
#include "core/tensor.hpp"
#include "solver/operators/kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace tessera::solver {

/// f(x) = sum_b weight_b f_b over the particles around a reference position x, the corrected kernel of
/// (3.57)-(3.59): weight_b = V_b alpha (1 + beta . (x - X_b)) W(|x - X_b|). The weights sum to one and
/// reproduce linear fields exactly; smooth ones to second order in the spacing. At a particle the value is
/// smoothed, not the particle's own.
struct Sampling {
  std::vector<std::int32_t> particle; ///< ascending
  std::vector<double> weight;         ///< one a particle; some are negative where x lies at a boundary
  double support = 0;                 ///< kernel radius about x, m

  /// The value at the point, of the same type as f(b): that of particle b.
  template <class F>
  auto operator()(F&& f) const {
    using Value = std::decay_t<decltype(f(particle[0]))>;
    Value value = weight[0] * f(particle[0]);
    for (std::size_t i = 1; i < particle.size(); ++i)
      value += weight[i] * f(particle[i]);
    return value;
  }
};

/// Weights at a reference position (m; in the plane its z means nothing). Its support begins at twice the
/// distance to the (D + 1)-th nearest particle and grows by tenths, at most fourfold, until its moment matrix
/// is conditioned better than 1e3 and the magnitudes of the weights sum to no more than 4. Particles hidden
/// from the one nearest to the point have no part.
///
/// Throws InputError where the point lies outside the cloud, that is farther from the nearest particle than
/// 1.25 times that particle's distance to its own 2D-th nearest (1.25 to 1.8 spacings on a lattice, 2.5 at a
/// plane one's corners), and where the particles about it are fewer than that or do not span D dimensions.
template <int D>
Sampling build_sampling(const Vec3& point, std::span<const Vec3> X, std::span<const double> V,
                        const HiddenPairs& hidden = {}, const Kernel<D>& kernel = {});

/// The same among `candidates`, ascending: what is not listed is not there.
template <int D>
Sampling build_sampling(const Vec3& point, std::span<const Vec3> X, std::span<const double> V,
                        std::span<const std::int32_t> candidates, const HiddenPairs& hidden,
                        const Kernel<D>& kernel = {});

} // namespace tessera::solver
