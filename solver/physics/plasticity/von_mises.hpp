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
    Symmetric plastic_metric = Symmetric::identity(); ///< C_p^-1, of unit determinant
    double equivalent_plastic_strain = 0;
  };

  /// First Piola-Kirchhoff stress, Pa; advances `history` to the end of the step that leads to `strain`.
  Mat3 piola(const Strain& strain, History& history) const {
    // Elastic predictor.
    const Deviation b(transform(strain.F, history.plastic_metric));
    Symmetric log_b = log_deviator(b);
    const double trial = hencky.elastic.mu * std::sqrt(1.5 * inner(log_b, log_b)); // von Mises stress

    // Admissibility.
    if (trial > hardening.yield_stress(history.equivalent_plastic_strain))
      flow(b, trial, log_b, strain.F, history);
    return hencky.piola_from(log_b, strain);
  }

  /// The same if it did not flow any further.
  Mat3 elastic_piola(const Strain& strain, const History& history) const {
    return hencky.piola_from(elastic_log_deviator(strain, history), strain);
  }

  /// Stored elastic energy, J/m^3.
  double energy(const Strain& strain, const History& history) const {
    return hencky.energy_from(elastic_log_deviator(strain, history), strain.J);
  }

  /// Largest modulus of pressure waves, Pa: StiffeningLaw. That of the volume alone, for the elastic deviator
  /// adds no more than 2/3 of the yield stress.
  double stiffened_modulus(const Strain& strain, const Vec3& squared) const {
    const ElasticConstants& elastic = hencky.elastic;
    return (elastic.pressure_wave_modulus() - elastic.kappa * std::log(strain.J)) / squared[0];
  }

  ElasticConstants linearised() const { return hencky.linearised(); }

  static double equivalent_plastic_strain(const History& history) {
    return history.equivalent_plastic_strain;
  }
  double plastic_work(const History& history) const {
    return hardening.work(history.equivalent_plastic_strain);
  }

 private:
  /// Return mapping from a von Mises stress `trial`, Pa: the deviator of ln b shrinks radially, the volume is
  /// left alone; C_p^-1 = F^-1 b F^-T.
  [[gnu::noinline]] void flow(const Deviation& b, double trial, Symmetric& log_b, const Mat3& F,
                              History& history) const {
    const double mu = hencky.elastic.mu;
    const double multiplier = hardening.return_to_yield(trial, history.equivalent_plastic_strain, mu);
    log_b = (1 - 3 * mu * multiplier / trial) * log_b;
    const double J = determinant(F);
    const double volume = b.mean * std::exp(std::log(b.relative_determinant()) / 3); // det(b)^(1/3)
    history.plastic_metric =
        volume / (J * J) * transform(cofactor(F).transpose(), exponential(Deviator(log_b)));
    history.equivalent_plastic_strain += multiplier;
  }

  static Symmetric elastic_log_deviator(const Strain& strain, const History& history) {
    return log_deviator(Deviation(transform(strain.F, history.plastic_metric)));
  }
};

} // namespace tessera::solver
