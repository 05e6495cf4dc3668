/// Nearly incompressible Mooney-Rivlin law, (2.68), (2.132):
/// Psi = c1 (J^(-2/3) F:F - 3) + c2 (J^(-4/3) H:H - 3) + kappa/2 (J - 1)^2.
#pragma once

#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/materials/principal_waves.hpp"
#include "solver/physics/strain.hpp"

namespace tessera::solver {

struct MooneyRivlin {
  double c1;    ///< of the fibre map, Pa; mu_1 / 2
  double c2;    ///< of the area map, Pa; -mu_2 / 2
  double kappa; ///< bulk modulus, Pa

  struct History {};

  /// First Piola-Kirchhoff stress, Pa: P = Sigma_F + Sigma_H x F + Sigma_J H with
  /// Sigma_F = 2 c1 J^(-2/3) F, Sigma_H = 2 c2 J^(-4/3) H and
  /// Sigma_J = -2/3 c1 J^(-5/3) F:F - 4/3 c2 J^(-7/3) H:H + kappa (J - 1).
  Mat3 piola(const Strain& strain, History&) const {
    const auto& [F, H, J] = strain;
    // Gathered so that nothing is left at F = I but exact zeros.
    const double root = isochoric_factor(J);
    return 2 * c1 * root * (F - F.squaredNorm() / (3 * J) * H) +
           2 * c2 * root * root * (cross(H, F) - 2 * H.squaredNorm() / (3 * J) * H) + kappa * (J - 1) * H;
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const auto& [F, H, J] = strain;
    const double root = isochoric_factor(J);
    return c1 * (root * F.squaredNorm() - 3) + c2 * (root * root * H.squaredNorm() - 3) +
           0.5 * kappa * (J - 1) * (J - 1);
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw.
  double stiffened_modulus(const Strain& strain, const Vec3& squared) const {
    const Vec3 isochoric = isochoric_factor(strain.J) * squared;
    PrincipalWaves waves(squared);
    waves.add_power(2 * c1, 2, isochoric);
    waves.add_power(-2 * c2, -2, isochoric.cwiseInverse());
    waves.add_volume(strain.J * strain.J * kappa);
    return waves.largest_modulus();
  }

  ElasticConstants linearised() const { return ElasticConstants::from_shear_and_bulk(2 * (c1 + c2), kappa); }
};

} // namespace tessera::solver
