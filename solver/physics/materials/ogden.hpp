/// Nearly incompressible Ogden law, (2.74), with the isochoric factor of (2.142) term by term:
/// Psi = sum_p mu_p/alpha_p (J^(-alpha_p/3) sum_i lambda_i^alpha_p - 3)
///       + kappa/beta^2 (beta ln J + J^(-beta) - 1), lambda_i the principal stretches of F, beta = 9.
#pragma once

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
    const Principal principal(strain.F);
    Vec3 fibre = Vec3::Zero(); // of Sigma_F = n diag(fibre) n^T F: N_i = F^T n_i / lambda_i needs no axes of
                               // its own, and any axes do where stretches are equal
    double volume = 0;         // of Sigma_J
    for (const OgdenTerm& term : terms) {
      const double scale = term.mu * std::pow(strain.J, -term.alpha / 3);
      const Vec3 powers = (term.alpha * principal.log_stretch).array().exp();
      fibre += scale * (powers.array() / principal.squared.array()).matrix();
      volume -= scale * powers.sum() / (3 * strain.J);
    }
    volume += kappa / (beta * strain.J) * (1 - std::pow(strain.J, -beta));
    return principal.axes * fibre.asDiagonal() * (principal.axes.transpose() * strain.F) + volume * strain.H;
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const Principal principal(strain.F);
    const double log_J = std::log(strain.J);
    double energy = kappa / (beta * beta) * (beta * log_J + std::expm1(-beta * log_J));
    for (const OgdenTerm& term : terms) {
      const Vec3 powers = (term.alpha * (principal.log_stretch.array() - log_J / 3)).exp();
      energy += term.mu / term.alpha * (powers.sum() - 3);
    }
    return energy;
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw.
  double stiffened_modulus(const Strain& strain) const {
    PrincipalWaves waves(strain);
    for (const OgdenTerm& term : terms)
      waves.add_power(term.mu, term.alpha);
    waves.add_volume(kappa / beta * ((beta + 1) * std::pow(strain.J, -beta) - 1));
    return waves.largest_modulus();
  }

  /// Shear modulus sum_p mu_p alpha_p / 2.
  ElasticConstants linearised() const {
    double mu = 0;
    for (const OgdenTerm& term : terms)
      mu += 0.5 * term.mu * term.alpha;
    return ElasticConstants::from_shear_and_bulk(mu, kappa);
  }

 private:
  struct Principal {
    Vec3 squared;     ///< lambda_i^2
    Vec3 log_stretch; ///< ln lambda_i
    Mat3 axes;        ///< columns n_i

    explicit Principal(const Mat3& F) {
      const Eigen::SelfAdjointEigenSolver<Mat3> eigen(F * F.transpose());
      squared = eigen.eigenvalues();
      log_stretch = 0.5 * squared.array().log();
      axes = eigen.eigenvectors();
    }
  };
};

} // namespace tessera::solver
