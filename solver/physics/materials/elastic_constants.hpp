/// Moduli of isotropic linear elasticity.
#pragma once

namespace tessera::solver {

struct ElasticConstants {
  double mu;     ///< shear modulus, Pa
  double lambda; ///< first Lame parameter, Pa
  double kappa;  ///< bulk modulus, Pa

  static constexpr ElasticConstants from(double young, double poisson) {
    const double mu = young / (2 * (1 + poisson));
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    return {mu, lambda, lambda + 2 * mu / 3};
  }

  static constexpr ElasticConstants from_shear_and_bulk(double mu, double kappa) {
    return {mu, kappa - 2 * mu / 3, kappa};
  }

  constexpr double young() const { return 9 * kappa * mu / (3 * kappa + mu); } ///< Pa
  constexpr double poisson() const { return (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu)); }

  /// Modulus of pressure waves, lambda + 2 mu, Pa.
  constexpr double pressure_wave_modulus() const { return lambda + 2 * mu; }
};

} // namespace tessera::solver
