/// The Stoermer-Verlet step: one evaluation of the forces a step, and twice the step Heun's method bears.
#pragma once

#include "solver/time/advance.hpp"
#include "solver/time/step.hpp"

#include <algorithm>
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
  void prepare(Body& body, double dt) override {
    body.strain_rates();
    forces(body, 0, dt);
  }

  void take(Body& body, double time, double dt) override {
    kick(body, 0.5 * dt);
    if constexpr (Body::dissipates_J) {
      this->note_change_of_J(dt, body.R.J);
      advance(body.U.J, dt, body.R.J);
    }
    this->limit(body, body.U.x, time, dt);
    this->hold(body, time + 0.5 * dt);

    body.strain_rates();
    drift(body, dt);
    body.commit();

    forces(body, time + dt, dt);
    kick(body, 0.5 * dt);
    this->limit(body, body.U.x, time + dt, dt);
    this->hold(body, time + dt);
  }

  void forces(Body& body, double time, double dt) {
    if constexpr (Body::dissipates_J)
      std::fill(body.R.J.begin(), body.R.J.end(), 0.0);
    body.momentum_rates();
    this->conserve(body, body.U.x);
    this->load(body, body.U.x, time, dt, 1);
  }

  void kick(Body& body, double dt) {
    this->note(body, dt);
    advance(body.U.p, dt, body.R.p);
  }

  /// cof(F + dt G) = cof F + dt (F + dt/2 G) x G exactly.
  void drift(Body& body, double dt) {
    auto& U = body.U;
    auto& R = body.R;
    advance(U.x, dt, R.x);
    if constexpr (Body::Formulation::evolves_J) {
      advance(U.F, 0.5 * dt, R.F);
      body.map_rates();
      if constexpr (Body::Formulation::evolves_H) {
        drift_H(body, 0.5 * dt);
        body.map_rates();
      }
      this->note_J(body, dt);
      advance(U.J, dt, R.J);
      if constexpr (Body::Formulation::evolves_H)
        drift_H(body, 0.5 * dt);
      advance(U.F, 0.5 * dt, R.F);
    } else if constexpr (Body::Formulation::evolves_F) {
      advance(U.F, dt, R.F);
    }
  }

  void drift_H(Body& body, double dt) {
    this->note_H(body, dt);
    advance(body.U.H, dt, body.R.H);
  }
};

} // namespace tessera::solver
