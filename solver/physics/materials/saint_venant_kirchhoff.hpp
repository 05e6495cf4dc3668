/// Saint Venant and Kirchhoff's law: Psi = mu E:E + lambda/2 tr(E)^2 with Green's strain E = (F^T F - I)/2.
#pragma once

#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/strain.hpp"

namespace tessera::solver {

/// Large rotations, moderate strains: compressed below about 0.58 of its length it softens and collapses.
struct SaintVenantKirchhoff {
  ElasticConstants elastic;

  struct History {};

  /// First Piola-Kirchhoff stress, Pa: P = F (2 mu E + lambda tr(E) I).
  Mat3 piola(const Strain& strain, History&) const {
    const Symmetric E = green_strain(strain.F);
    const Symmetric S = add_isotropic(2 * elastic.mu * E, elastic.lambda * E.trace());
    return strain.F * S.matrix();
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const Symmetric E = green_strain(strain.F);
    return elastic.mu * inner(E, E) + 0.5 * elastic.lambda * E.trace() * E.trace();
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw.
  double stiffened_modulus(const Strain&, const Vec3& squared) const {
    const double trace_E = 0.5 * (squared.sum() - 3), largest = squared[2];
    return elastic.lambda * (trace_E + largest) + elastic.mu * (3 * largest - 1);
  }

  ElasticConstants linearised() const { return elastic; }

 private:
  static Symmetric green_strain(const Mat3& F) {
    return 0.5 * add_isotropic(left_cauchy_green(F.transpose()), -1); // C = F^T F
  }
};

} // namespace tessera::solver
