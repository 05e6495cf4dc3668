/// Hencky's hyperelastic law, (2.116) and (5.5): Psi = mu sum_i (ln lambda^_i)^2 + kappa/2 (ln J)^2,
/// with lambda^_i = J_F^(-1/3) lambda_i the isochoric principal stretches.
#pragma once

#include "solver/physics/isotropic.hpp"
#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/strain.hpp"

#include <cmath>

namespace tessera::solver {

struct Hencky {
  ElasticConstants elastic;

  /// An elastic law remembers nothing.
  struct History {};

  /// First Piola-Kirchhoff stress, Pa. P = tau' F^-T + (kappa ln J / J) H: the deviator belongs to F, the
  /// pressure to the formulation's J and H.
  Mat3 piola(const Strain& strain, History&) const {
    return piola_from(log_deviator(Deviation(left_cauchy_green(strain.F))), strain);
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    return energy_from(log_deviator(Deviation(left_cauchy_green(strain.F))), strain.J);
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw. The modulus falls
  /// with the stretch wherever it is positive: the smallest stretch has the largest.
  double stiffened_modulus(const Strain& strain, const Vec3& squared) const {
    const double log_J = std::log(strain.J), isochoric = 0.5 * std::log(squared[0]) - log_J / 3;
    return (2 * elastic.mu * (2.0 / 3 - isochoric) + elastic.kappa * (1 - log_J)) / squared[0];
  }

  ElasticConstants linearised() const { return elastic; }

  /// P from the deviator of ln b, b the elastic left Cauchy-Green tensor.
  [[gnu::always_inline]] Mat3 piola_from(const Symmetric& log_b, const Strain& strain) const {
    const Mat3 H_F = cofactor(strain.F);
    const Mat3 tau = (elastic.mu / determinant(strain.F) * log_b).matrix();
    return tau * H_F + (elastic.kappa * std::log(strain.J) / strain.J) * strain.H;
  }

  double energy_from(const Symmetric& log_b, double J) const {
    const double log_J = std::log(J);
    return 0.25 * elastic.mu * inner(log_b, log_b) + 0.5 * elastic.kappa * log_J * log_J;
  }
};

} // namespace tessera::solver
