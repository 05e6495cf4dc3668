/// Isotropic hardening: the yield stress as a function of the equivalent plastic strain.
#pragma once

namespace tessera::solver {

/// sigma_Y = yield + modulus * eps.
struct LinearHardening {
  double yield;   ///< initial yield stress, Pa
  double modulus; ///< hardening modulus, Pa

  double yield_stress(double eps) const { return yield + modulus * eps; }

  /// Plastic work per volume up to eps: the integral of the yield stress, J/m^3.
  double work(double eps) const { return (yield + 0.5 * modulus * eps) * eps; }

  /// Plastic multiplier that brings a trial stress of von Mises norm `trial` (Pa) back to the yield surface:
  /// trial - 3 mu dgamma = sigma_Y(eps + dgamma).
  double return_to_yield(double trial, double eps, double mu) const {
    return (trial - yield_stress(eps)) / (3 * mu + modulus);
  }
};

} // namespace tessera::solver
