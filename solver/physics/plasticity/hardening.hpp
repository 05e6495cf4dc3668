/// Isotropic hardening: the yield stress as a function of the equivalent plastic strain.
///
/// A hardening offers
///   yield_stress(eps)                Pa
///   work(eps)                        plastic work per volume up to eps, J/m^3: the integral of yield_stress
///   return_to_yield(trial, eps, mu)  plastic multiplier that brings a trial stress of von Mises norm `trial`
///                                    (Pa), beyond the yield stress, back to the yield surface:
///                                    trial - 3 mu dgamma = sigma_Y(eps + dgamma)
#pragma once

#include "solver/physics/plasticity/newton.hpp"

#include <cmath>

namespace tessera::solver {

/// sigma_Y = yield + modulus * eps.
struct LinearHardening {
  double yield;   ///< initial yield stress, Pa
  double modulus; ///< hardening modulus, Pa

  double yield_stress(double eps) const { return yield + modulus * eps; }
  double work(double eps) const { return (yield + 0.5 * modulus * eps) * eps; }
  double return_to_yield(double trial, double eps, double mu) const {
    return (trial - yield_stress(eps)) / (3 * mu + modulus);
  }
};

/// sigma_Y = coefficient * (offset + eps)^exponent, (5.7).
struct PowerHardening {
  double coefficient; ///< Pa, positive
  double offset;      ///< positive: the first yield stress is coefficient * offset^exponent
  double exponent;    ///< 0 (perfectly plastic) to 1 (linear)

  double yield_stress(double eps) const { return coefficient * std::pow(offset + eps, exponent); }

  double work(double eps) const {
    return ((offset + eps) * yield_stress(eps) - offset * yield_stress(0)) / (exponent + 1);
  }

  /// The residual is convex, so that Newton's steps from zero approach the root from below.
  double return_to_yield(double trial, double eps, double mu) const {
    const auto residual = [&](double multiplier) -> Tangent {
      const double stress = yield_stress(eps + multiplier);
      return {trial - 3 * mu * multiplier - stress,
              -3 * mu - exponent * stress / (offset + eps + multiplier)};
    };
    const double perfectly_plastic = (trial - yield_stress(eps)) / (3 * mu);
    return decreasing_root(residual, 0, perfectly_plastic, 1e-14 * trial);
  }
};

} // namespace tessera::solver
