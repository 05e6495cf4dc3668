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
    const Mat3 E = green_strain(strain.F);
    return strain.F * (2 * elastic.mu * E + elastic.lambda * E.trace() * Mat3::Identity());
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const Mat3 E = green_strain(strain.F);
    return elastic.mu * E.squaredNorm() + 0.5 * elastic.lambda * E.trace() * E.trace();
  }

  /// Largest modulus of pressure waves along the principal directions, Pa: StiffeningLaw.
  double stiffened_modulus(const Strain& strain) const {
    const Vec3 squared = squared_stretches(strain.F);
    const double trace_E = 0.5 * (squared.sum() - 3), largest = squared.maxCoeff();
    return elastic.lambda * (trace_E + largest) + elastic.mu * (3 * largest - 1);
  }

  ElasticConstants linearised() const { return elastic; }

 private:
  static Mat3 green_strain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }
};

} // namespace tessera::solver
