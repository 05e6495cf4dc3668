/// The Stoermer-Verlet step: one evaluation of the forces a step, and twice the step Heun's method bears.
#pragma once

#include "solver/time/step.hpp"

#include <utility>

namespace tessera::solver {

/// p^(n+1/2) = p^n + dt/2 R(U^n),  x and strains drift by p^(n+1/2) over dt,  p^(n+1) = p^(n+1/2) + dt/2
/// R(U^(n+1)) with the dissipation of p^(n+1/2): of second order but for the dissipation, which lags by half
/// a step. x x p is changed by forces only, so that these are projected about the x they belong to.
/// H and J drift by dF/dt at the middle of the step; their own dissipation lags by a whole one.
template <class Body>
class Verlet final : public Step<Body> {
 public:
  static constexpr int D = Body::dimension;

  Verlet(Conditions<D> conditions, bool momentum_projection)
      : Step<Body>(std::move(conditions), momentum_projection) {}

 private:
  using Formulation = typename Body::Formulation;

  void prepare(Body& body, double dt) override {
    body.sweep_momenta(body.U, [](std::int64_t, const Mat<D>&) {});
    forces(body, 0, dt);
  }

  void take(Body& body, double time, double dt) override {
    auto& U = body.U;
    const auto& U_n = this->before_;

    kick(body, U_n.p, 0.5 * dt);
    if constexpr (Body::dissipates_J)
      for_each(body.size(), [&](std::int64_t a) {
        this->note_J(a, dt * body.R.J[a]);
        U.J[a] = U_n.J[a] + dt * body.R.J[a];
      });
    this->limit(body, U_n.x, time, dt);
    this->hold(body, time + 0.5 * dt);

    body.sweep_momenta(U, [&](std::int64_t a, const Mat<D>& G) { drift(body, a, dt, G); });
    body.commit();

    forces(body, time + dt, dt);
    kick(body, U.p, 0.5 * dt);
    this->limit(body, U.x, time + dt, dt);
    this->hold(body, time + dt);
  }

  void forces(Body& body, double time, double dt) {
    this->load(body, body.strains(), time);
    body.sweep_stresses();
    this->conserve(body, body.U.x);
    this->act(body, body.U.x, body.U.p, time, dt, 1);
  }

  void kick(Body& body, const std::vector<Vec<D>>& p, double dt) {
    for_each(body.size(), [&](std::int64_t a) {
      this->note(body, a, dt);
      body.U.p[a] = p[a] + dt * body.R.p[a];
    });
  }

  /// A particle's way by its velocity, and its strains by dF/dt = G.
  void drift(Body& body, std::int64_t a, double dt, const Mat<D>& G) {
    auto& U = body.U;
    const auto& U_n = this->before_;
    U.x[a] = U_n.x[a] + dt * body.velocity(a);
    if constexpr (Formulation::evolves_J) {
      U.F[a] = U_n.F[a] + 0.5 * dt * G;
      if constexpr (!Body::dissipates_J)
        U.J[a] = U_n.J[a];
      if constexpr (Formulation::evolves_H) {
        U.H[a] = U_n.H[a];
        drift_H(body, a, 0.5 * dt, body.map_rates(U, a, G));
      }
      const auto rates = body.map_rates(U, a, G);
      this->note_J(a, dt * rates.J_pull);
      U.J[a] += dt * (rates.J + rates.J_pull);
      if constexpr (Formulation::evolves_H)
        drift_H(body, a, 0.5 * dt, rates);
      U.F[a] += 0.5 * dt * G;
    } else if constexpr (Formulation::evolves_F) {
      U.F[a] = U_n.F[a] + dt * G;
    }
  }

  /// cof(F + dt G) = cof F + dt (F + dt/2 G) x G exactly.
  void drift_H(Body& body, std::int64_t a, double dt, const typename Body::MapRates& rates) {
    this->note_H(a, dt * rates.H_pull);
    body.U.H[a] += dt * (rates.H + rates.H_pull);
  }
};

} // namespace tessera::solver
