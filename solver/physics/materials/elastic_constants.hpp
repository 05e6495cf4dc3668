/// Moduli of isotropic elasticity from Young's modulus and Poisson's ratio.
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

  /// Modulus of pressure waves, lambda + 2 mu, Pa.
  constexpr double pressure_wave_modulus() const { return lambda + 2 * mu; }
};

} // namespace tessera::solver
