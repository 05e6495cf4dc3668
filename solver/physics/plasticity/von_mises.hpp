/// Von Mises plasticity at finite strain on Hencky elasticity: multiplicative, principal axes, radial return
/// (algorithm 2).
#pragma once

#include "solver/physics/materials/hencky.hpp"

#include <cmath>

namespace tessera::solver {

template <class Hardening>
struct VonMises {
  Hencky hencky;
  Hardening hardening;

  struct History {
    Mat3 plastic_metric = Mat3::Identity(); ///< C_p^-1, of unit determinant
    double equivalent_plastic_strain = 0;
  };

  /// First Piola-Kirchhoff stress, Pa; advances `history` to the end of the step that leads to `strain`.
  Mat3 piola(const Strain& strain, History& history) const {
    // Elastic predictor.
    const PrincipalLogStrain trial(strain.F * history.plastic_metric * strain.F.transpose());
    const double mu = hencky.elastic.mu;
    const Vec3 tau_trial = 2 * mu * trial.deviator;
    const double von_mises_trial = std::sqrt(1.5) * tau_trial.norm();

    // Admissibility.
    if (von_mises_trial <= hardening.yield_stress(history.equivalent_plastic_strain))
      return hencky.piola_from(tau_trial, trial.axes, strain);

    // Return mapping: the deviator shrinks radially, the volume is left alone.
    const double multiplier =
        hardening.return_to_yield(von_mises_trial, history.equivalent_plastic_strain, mu);
    const double shrink = 1 - 3 * mu * multiplier / von_mises_trial;
    const Vec3 elastic_stretch_squared = (2 * (shrink * trial.deviator.array() + trial.mean)).exp();
    const Mat3 b_elastic = trial.axes * elastic_stretch_squared.asDiagonal() * trial.axes.transpose();
    const Mat3 F_inverse = strain.F.inverse();
    history.plastic_metric = F_inverse * b_elastic * F_inverse.transpose();
    history.equivalent_plastic_strain += multiplier;
    return hencky.piola_from(shrink * tau_trial, trial.axes, strain);
  }

  /// The same if it did not flow any further.
  Mat3 elastic_piola(const Strain& strain, const History& history) const {
    const PrincipalLogStrain elastic(strain.F * history.plastic_metric * strain.F.transpose());
    return hencky.piola_from(2 * hencky.elastic.mu * elastic.deviator, elastic.axes, strain);
  }

  /// Stored elastic energy, J/m^3.
  double energy(const Strain& strain, const History& history) const {
    const PrincipalLogStrain elastic(strain.F * history.plastic_metric * strain.F.transpose());
    return hencky.energy_from(elastic.deviator, strain.J);
  }

  /// Largest modulus of pressure waves, Pa: StiffeningLaw. That of the volume alone, for the elastic deviator
  /// adds no more than 2/3 of the yield stress.
  double stiffened_modulus(const Strain& strain) const {
    const ElasticConstants& elastic = hencky.elastic;
    return (elastic.pressure_wave_modulus() - elastic.kappa * std::log(strain.J)) /
           squared_stretches(strain.F).minCoeff();
  }

  ElasticConstants linearised() const { return hencky.linearised(); }

  static double equivalent_plastic_strain(const History& history) {
    return history.equivalent_plastic_strain;
  }
  double plastic_work(const History& history) const {
    return hardening.work(history.equivalent_plastic_strain);
  }
};

} // namespace tessera::solver
