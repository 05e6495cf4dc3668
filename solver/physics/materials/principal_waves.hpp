/// How stiff a strained isotropic body is to waves: what the stable step goes by beside (3.93).
#pragma once

#include "core/tensor.hpp"

namespace tessera::solver {

/// Moduli d^2 Psi / d lambda_i^2 = rho0 c^2, Pa, of the pressure waves along the principal directions i, as
/// seen from the reference configuration, gathered term by term in logarithmic stretches e_i = ln lambda_i:
/// lambda_i^2 d^2 Psi / d lambda_i^2 = d^2 Psi / d e_i^2 - d Psi / d e_i.
class PrincipalWaves {
 public:
  explicit PrincipalWaves(const Vec3& squared_stretches) : squared_(squared_stretches) {}

  /// mu/alpha (sum_i x_i - 3) with x_i = J^(-alpha/3) lambda_i^alpha, mu in Pa.
  void add_power(double mu, double alpha, const Vec3& x) {
    const double sum = x.sum();
    scaled_.array() += mu * ((alpha / 3 - 1) * x.array() + (alpha / 9 + 1.0 / 3) * sum);
  }

  /// U(J): J^2 U''(J), Pa.
  void add_volume(double curvature) { scaled_.array() += curvature; }

  double largest_modulus() const { return (scaled_.array() / squared_.array()).maxCoeff(); } ///< Pa

 private:
  Vec3 squared_;               ///< lambda_i^2
  Vec3 scaled_ = Vec3::Zero(); ///< lambda_i^2 times the moduli, Pa
};

} // namespace tessera::solver
