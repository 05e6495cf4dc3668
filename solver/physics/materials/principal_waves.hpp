/// How stiff a strained isotropic body is to waves: what the stable step goes by beside (3.93).
#pragma once

#include "solver/physics/strain.hpp"

#include <cmath>

namespace tessera::solver {

/// Moduli d^2 Psi / d lambda_i^2 = rho0 c^2, Pa, of the pressure waves along the principal directions i, as
/// seen from the reference configuration, gathered term by term in logarithmic stretches e_i = ln lambda_i:
/// lambda_i^2 d^2 Psi / d lambda_i^2 = d^2 Psi / d e_i^2 - d Psi / d e_i. The volume ratio is the
/// formulation's own.
class PrincipalWaves {
 public:
  explicit PrincipalWaves(const Strain& strain)
      : squared_(squared_stretches(strain.F)),
        isochoric_(0.5 * squared_.array().log() - std::log(strain.J) / 3) {}

  /// mu/alpha (J^(-alpha/3) sum_i lambda_i^alpha - 3), mu in Pa.
  void add_power(double mu, double alpha) {
    const Vec3 x = (alpha * isochoric_).array().exp();
    const double sum = x.sum();
    scaled_.array() += mu * (alpha * (x.array() / 3 + sum / 9) - x.array() + sum / 3);
  }

  /// mu sum_i (ln lambda_i - ln J / 3)^2, mu in Pa.
  void add_logarithmic(double mu) { scaled_.array() += 2 * mu * (2.0 / 3 - isochoric_.array()); }

  /// U(J): J^2 U''(J), Pa.
  void add_volume(double curvature) { scaled_.array() += curvature; }

  double largest_modulus() const { return (scaled_.array() / squared_.array()).maxCoeff(); } ///< Pa

 private:
  Vec3 squared_;               ///< lambda_i^2
  Vec3 isochoric_;             ///< ln lambda_i - ln J / 3
  Vec3 scaled_ = Vec3::Zero(); ///< lambda_i^2 times the moduli, Pa
};

} // namespace tessera::solver
