/// A body of particles in the {p, F} formulation: its fields, its law, and the rates of section 3.4, (3.82).
#pragma once

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solver/operators/gradient.hpp"
#include "solver/physics/jst.hpp"
#include "solver/physics/pf.hpp"
#include "solver/physics/strain.hpp"
#include "solver/physics/stress_measures.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tessera::solver {

/// Thrown where a particle's state stops making sense; whoever runs the body turns it into a RunError.
struct Breakdown {
  std::int64_t particle;
  double J; ///< det F at the particle; not positive, or positive where another field is not finite
};

template <int D, class Law, class Dissipation>
class Body {
 public:
  using Formulation = PF<D>;
  static constexpr int dimension = D;

  Body(std::vector<Vec<D>> X, std::vector<double> subvolumes, double reference_density,
       double pressure_wave_speed, const Law& material_law, Neighbours graph, Gradient<D> gradient_weights,
       Dissipation jst)
      : V(std::move(subvolumes)), density(reference_density), wave_speed(pressure_wave_speed),
        law(material_law), neighbours(std::move(graph)), gradient(std::move(gradient_weights)),
        dissipation(std::move(jst)), U(X.size()), R(X.size()), history(X.size()), P(X.size(), Mat<D>::Zero()),
        T(X.size(), Vec<D>::Zero()), stretch(X.size(), 1.0) {
    U.x = std::move(X);
    if constexpr (Dissipation::active)
      dissipation.lap_p.assign(V.size(), Vec<D>::Zero());
    commit();
  }

  std::int64_t size() const { return static_cast<std::int64_t>(V.size()); }

  /// R = rates of U: dF/dt = G = grad v, dx/dt = v, dp/dt = T + D, with T alone kept beside it. P must belong
  /// to U.
  void rates() {
    strain_rates();
    momentum_rates();
  }

  /// P of U with the history as it stands: stresses within a step. Throws Breakdown.
  void stresses() {
    check();
    for_each(size(), [&](std::int64_t a) {
      typename Law::History trial = history[a];
      P[a] = piola(a, trial);
    });
  }

  /// The step is over: the history advances to U, P and the stretches follow. Throws Breakdown, before any
  /// change.
  void commit() {
    check();
    for_each(size(), [&](std::int64_t a) {
      P[a] = piola(a, history[a]);
      stretch[a] = smallest_stretch<D>(U.F[a]);
    });
  }

  /// Largest pressure wave speed as the body is deformed: the undeformed one over the smallest stretch,
  /// (3.93), m/s.
  double fastest_wave() const {
    return wave_speed / min_of(size(), 1.0, [&](std::int64_t a) { return stretch[a]; });
  }

  Vec<D> velocity(std::int64_t a) const { return U.p[a] / density; }
  Strain strain(std::int64_t a) const { return Strain::of(embed(U.F[a])); }

  const std::vector<double> V; ///< subvolumes, m^3
  const double density;        ///< reference density, kg/m^3
  const double wave_speed;     ///< of pressure waves, undeformed, m/s
  const Law law;
  const Neighbours neighbours;
  const Gradient<D> gradient;
  Dissipation dissipation;

  Formulation U;                              ///< the state
  Formulation R;                              ///< its rates
  std::vector<typename Law::History> history; ///< as of the last commit
  std::vector<Mat<D>> P;                      ///< first Piola-Kirchhoff stress of U, Pa
  std::vector<Vec<D>> T;                      ///< divergence of P alone, N/m^3
  std::vector<double> stretch;                ///< smallest principal stretch at the last commit

 private:
  Mat<D> piola(std::int64_t a, typename Law::History& memory) const {
    return law.piola(strain(a), memory).template topLeftCorner<D, D>();
  }

  void check() const {
    for_each(size(), [&](std::int64_t a) {
      const double J = U.F[a].determinant();
      if (!(J > 0) || !std::isfinite(J) || !U.p[a].allFinite())
        throw Breakdown{a, J};
    });
  }

  /// One sweep over the edges gathers v for G and, where there is dissipation, lap p.
  void strain_rates() {
    for_each(size(), [&](std::int64_t a) {
      Mat<D> G = -U.p[a] * gradient.s[a].transpose();
      Vec<D> lap_p = Vec<D>::Zero();
      if constexpr (Dissipation::active)
        lap_p = -dissipation.laplacian.sum[a] * U.p[a];
      for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
        const Vec<D>& p_b = U.p[neighbours.column[e]];
        for (int c = 0; c < D; ++c)
          G.col(c) += gradient.w[e][c] * p_b;
        if constexpr (Dissipation::active)
          lap_p += dissipation.laplacian.l[e] * p_b;
      }
      R.F[a] = G / density;
      R.x[a] = U.p[a] / density;
      if constexpr (Dissipation::active)
        dissipation.lap_p[a] = lap_p;
    });
  }

  /// The second sweep gathers P for T and, where there is dissipation, lap p for lap(lap p).
  void momentum_rates() {
    for_each(size(), [&](std::int64_t a) {
      Vec<D> divergence = P[a] * gradient.s[a];
      Vec<D> lap_lap_p = Vec<D>::Zero();
      if constexpr (Dissipation::active)
        lap_lap_p = -dissipation.laplacian.sum[a] * dissipation.lap_p[a];
      for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
        const std::int32_t b = neighbours.column[e];
        divergence += P[b] * gradient.t[e];
        if constexpr (Dissipation::active)
          lap_lap_p += dissipation.laplacian.l[e] * dissipation.lap_p[b];
      }
      T[a] = divergence;
      R.p[a] = divergence;
      if constexpr (Dissipation::active)
        R.p[a] -= dissipation.kappa4_delta3 * (wave_speed / stretch[a]) * lap_lap_p;
    });
  }
};

} // namespace tessera::solver
