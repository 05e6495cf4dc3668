/// Nearly incompressible Ogden law, (2.74), with the isochoric factor of (2.142) term by term:
/// Psi = sum_p mu_p/alpha_p (J^(-alpha_p/3) sum_i lambda_i^alpha_p - 3)
///       + kappa/beta^2 (beta ln J + J^(-beta) - 1), lambda_i the principal stretches of F, beta = 9.
#pragma once

#include "solver/physics/isotropic.hpp"
#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/materials/principal_waves.hpp"
#include "solver/physics/strain.hpp"

#include <cmath>
#include <vector>

namespace tessera::solver {

struct OgdenTerm {
  double mu;    ///< Pa
  double alpha; ///< any number but zero
};

struct Ogden {
  static constexpr double beta = 9;

  std::vector<OgdenTerm> terms;
  double kappa; ///< bulk modulus, Pa

  struct History {};

  /// First Piola-Kirchhoff stress, Pa: P = Sigma_F + Sigma_J H with
  /// Sigma_F = sum_i [sum_p mu_p J^(-alpha_p/3) lambda_i^(alpha_p - 1)] n_i (x) N_i and
  /// Sigma_J = -sum_p mu_p/3 J^(-alpha_p/3 - 1) sum_i lambda_i^alpha_p + kappa/(beta J) (1 - J^(-beta)).
  Mat3 piola(const Strain& strain, History&) const {
    const Deviation b(left_cauchy_green(strain.F));
    const PrincipalValues principal(b);
    const Vec3 squared = b.mean * (1 + principal.values().array());
    const double log_J = std::log(strain.J);
    const Vec3 log_isochoric = 0.5 * squared.array().log() - log_J / 3;
    Vec3 fibre = Vec3::Zero(); // of Sigma_F = n diag(fibre) n^T F: N_i = F^T n_i / lambda_i needs no axes of
                               // its own
    double volume = 0;         // of J Sigma_J
    for (const OgdenTerm& term : terms) {
      const Vec3 powers = term.mu * (term.alpha * log_isochoric).array().exp();
      fibre.array() += powers.array() / squared.array();
      volume -= powers.sum() / 3;
    }
    volume -= kappa / beta * std::expm1(-beta * log_J);
    return principal.function(fibre).matrix() * strain.F + volume / strain.J * strain.H;
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const double log_J = std::log(strain.J);
    const Vec3 log_isochoric = 0.5 * squared_stretches(strain.F).array().log() - log_J / 3;
    double energy = kappa / (beta * beta) * (beta * log_J + std::expm1(-beta * log_J));
    for (const OgdenTerm& term : terms)
      energy += term.mu / term.alpha * ((term.alpha * log_isochoric).array().exp().sum() - 3);
    return energy;
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw.
  double stiffened_modulus(const Strain& strain, const Vec3& squared) const {
    const double log_J = std::log(strain.J);
    const Vec3 log_isochoric = 0.5 * squared.array().log() - log_J / 3;
    PrincipalWaves waves(squared);
    for (const OgdenTerm& term : terms)
      waves.add_power(term.mu, term.alpha, (term.alpha * log_isochoric).array().exp());
    waves.add_volume(kappa / beta * ((beta + 1) * std::exp(-beta * log_J) - 1));
    return waves.largest_modulus();
  }

  /// Shear modulus sum_p mu_p alpha_p / 2.
  ElasticConstants linearised() const {
    double mu = 0;
    for (const OgdenTerm& term : terms)
      mu += 0.5 * term.mu * term.alpha;
    return ElasticConstants::from_shear_and_bulk(mu, kappa);
  }
};

} // namespace tessera::solver
