/// Hencky's hyperelastic law, (2.116) and (5.5): Psi = mu sum_i (ln lambda^_i)^2 + kappa/2 (ln J)^2,
/// with lambda^_i = J_F^(-1/3) lambda_i the isochoric principal stretches.
#pragma once

#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/materials/principal_waves.hpp"
#include "solver/physics/strain.hpp"

#include <cmath>

namespace tessera::solver {

/// Deviatoric logarithmic strain of a left Cauchy-Green tensor b = F F^T, in its principal frame.
struct PrincipalLogStrain {
  Vec3 deviator; ///< ln lambda_i - mean
  double mean;   ///< (1/3) sum ln lambda_i
  Mat3 axes;     ///< columns n_i

  explicit PrincipalLogStrain(const Mat3& b) {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(b);
    const Vec3 log_stretch = 0.5 * eigen.eigenvalues().array().log();
    mean = log_stretch.mean();
    deviator = log_stretch.array() - mean;
    axes = eigen.eigenvectors();
  }
};

struct Hencky {
  ElasticConstants elastic;

  /// An elastic law remembers nothing.
  struct History {};

  /// First Piola-Kirchhoff stress, Pa. P = tau' F^-T + (kappa ln J / J) H: the deviator belongs to F, the
  /// pressure to the formulation's J and H.
  Mat3 piola(const Strain& strain, History&) const {
    const PrincipalLogStrain log_strain(strain.F * strain.F.transpose());
    return piola_from(2 * elastic.mu * log_strain.deviator, log_strain.axes, strain);
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const PrincipalLogStrain log_strain(strain.F * strain.F.transpose());
    return energy_from(log_strain.deviator, strain.J);
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw.
  double stiffened_modulus(const Strain& strain) const {
    PrincipalWaves waves(strain);
    waves.add_logarithmic(elastic.mu);
    waves.add_volume(elastic.kappa * (1 - std::log(strain.J)));
    return waves.largest_modulus();
  }

  ElasticConstants linearised() const { return elastic; }

  /// P from principal deviatoric Kirchhoff stresses tau' (Pa) along `axes`.
  Mat3 piola_from(const Vec3& tau_deviator, const Mat3& axes, const Strain& strain) const {
    const Mat3 tau = axes * tau_deviator.asDiagonal() * axes.transpose();
    const Mat3 H_F = cofactor(strain.F);
    const double J_F = strain.F.row(0).dot(H_F.row(0));
    return tau * H_F / J_F + (elastic.kappa * std::log(strain.J) / strain.J) * strain.H;
  }

  double energy_from(const Vec3& deviator, double J) const {
    const double log_J = std::log(J);
    return elastic.mu * deviator.squaredNorm() + 0.5 * elastic.kappa * log_J * log_J;
  }
};

} // namespace tessera::solver
