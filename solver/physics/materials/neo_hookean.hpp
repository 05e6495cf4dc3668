/// Nearly incompressible neo-Hookean law, (2.72), (2.133): Psi = mu/2 (J^(-2/3) F:F - 3) + kappa/2 (J - 1)^2.
#pragma once

#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/strain.hpp"

namespace tessera::solver {

struct NeoHookean {
  ElasticConstants elastic;

  struct History {};

  /// First Piola-Kirchhoff stress, Pa: P = Sigma_F + Sigma_J H with Sigma_F = mu J^(-2/3) F and
  /// Sigma_J = -mu/3 J^(-5/3) F:F + kappa (J - 1).
  Mat3 piola(const Strain& strain, History&) const {
    const auto& [F, H, J] = strain;
    // Gathered so that nothing is left at F = I but exact zeros.
    const double isochoric = elastic.mu * isochoric_factor(J);
    return isochoric * (F - F.squaredNorm() / (3 * J) * H) + elastic.kappa * (J - 1) * H;
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const auto& [F, H, J] = strain;
    return 0.5 * elastic.mu * (F.squaredNorm() * isochoric_factor(J) - 3) +
           0.5 * elastic.kappa * (J - 1) * (J - 1);
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw. The modulus falls
  /// with the stretch: the smallest stretch has the largest.
  double stiffened_modulus(const Strain& strain, const Vec3& squared) const {
    const double fibre = isochoric_factor(strain.J) * (5 * squared.sum() - 3 * squared[0]) / 9;
    return (elastic.mu * fibre + elastic.kappa * strain.J * strain.J) / squared[0];
  }

  ElasticConstants linearised() const { return elastic; }
};

} // namespace tessera::solver
