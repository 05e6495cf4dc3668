/// Linear elasticity of small strains (Hooke): Psi = mu e:e + lambda/2 tr(e)^2 with e = sym F - I.
#pragma once

#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/strain.hpp"

namespace tessera::solver {

/// Not objective: a rotation strains it. For small rotations only, and for comparison with closed solutions.
struct LinearElastic {
  ElasticConstants elastic;

  struct History {};

  /// First Piola-Kirchhoff stress, Pa: P = 2 mu e + lambda tr(e) I.
  Mat3 piola(const Strain& strain, History&) const {
    const Mat3 e = small_strain(strain.F);
    return 2 * elastic.mu * e + elastic.lambda * e.trace() * Mat3::Identity();
  }

  /// Stored energy, J/m^3.
  double energy(const Strain& strain, const History&) const {
    const Mat3 e = small_strain(strain.F);
    return elastic.mu * e.squaredNorm() + 0.5 * elastic.lambda * e.trace() * e.trace();
  }

  ElasticConstants linearised() const { return elastic; }

 private:
  static Mat3 small_strain(const Mat3& F) { return 0.5 * (F + F.transpose()) - Mat3::Identity(); }
};

} // namespace tessera::solver
