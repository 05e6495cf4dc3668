/// Heun's method: the thesis' two-stage TVD Runge-Kutta step, (3.99).
#pragma once

#include "solver/time/step.hpp"

#include <utility>
#include <vector>

namespace tessera::solver {

/// U* = U^n + dt R(U^n),  U^(n+1) = (U^n + U* + dt R(U*)) / 2; the forces are projected about x^n in the
/// first stage and about x^(n+1) = x^n + dt/(2 rho) (p^n + p*) in the second.
template <class Body>
class Heun final : public Step<Body> {
 public:
  static constexpr int D = Body::dimension;

  Heun(Conditions<D> conditions, bool momentum_projection)
      : Step<Body>(std::move(conditions), momentum_projection) {}

 private:
  using Formulation = typename Body::Formulation;

  std::size_t own_bytes() const override { return this->outside_.walls.empty() ? 0 : sizeof(Vec<D>); }

  void prepare(Body& body, double) override {
    if (!this->outside_.walls.empty())
      place_ = body.U.x;
  }

  void take(Body& body, double time, double dt) override {
    auto& U = body.U;
    const auto& U_n = this->before_;

    stage(body, U_n, time, dt, [dt](auto& u, const auto& u_n, const auto& rate) { u = u_n + dt * rate; });
    hold_middle(body, time, dt);
    body.stresses();

    if (this->pushed())
      place_ = U.x;
    stage(body, U, time + dt, dt,
          [dt](auto& u, const auto& u_n, const auto& rate) { u = 0.5 * (u_n + u + dt * rate); });
    this->limit(body, U.x, time + dt, dt);
    this->hold(body, time + dt);
    body.commit();
  }

  /// advance(u, u_n, rate) for every u of U and its rate by the state `at`, which may be U itself: each field
  /// of a particle is advanced once all that depends on it has been found.
  template <class Advance>
  void stage(Body& body, const Formulation& at, double time, double dt, Advance&& advance) {
    auto& U = body.U;
    const auto& U_n = this->before_;
    this->load(body, body.strains(at), time);
    body.sweep_momenta(at, [&](std::int64_t a, const Mat<D>& G) {
      if constexpr (Formulation::evolves_J) {
        const auto rates = body.map_rates(at, a, G);
        this->note_J(a, 0.5 * dt * rates.J_pull);
        advance(U.J[a], U_n.J[a], rates.J + rates.J_pull);
        if constexpr (Formulation::evolves_H) {
          this->note_H(a, 0.5 * dt * rates.H_pull);
          advance(U.H[a], U_n.H[a], rates.H + rates.H_pull);
        }
      }
      advance(U.x[a], U_n.x[a], at.p[a] / body.density);
      if constexpr (Formulation::evolves_F)
        advance(U.F[a], U_n.F[a], G);
    });
    body.sweep_stresses();
    const bool first = &at == &U_n;
    this->conserve(body, first ? U_n.x : U.x);
    this->act(body, first ? U_n.x : place_, at.p, time, dt, 0.5);
    for_each(body.size(), [&](std::int64_t a) {
      this->note(body, a, 0.5 * dt);
      advance(U.p[a], U_n.p[a], body.R.p[a]);
      if constexpr (Body::dissipates_J) {
        this->note_J(a, 0.5 * dt * body.R.J[a]);
        U.J[a] += (first ? dt : 0.5 * dt) * body.R.J[a];
      }
    });
  }

  /// The first stage's momenta move a particle from the middle of x^n and x* to x^(n+1), in dt/2.
  void hold_middle(Body& body, double time, double dt) {
    if (!this->outside_.walls.empty())
      for_each(body.size(), [&](std::int64_t a) { place_[a] = 0.5 * (this->before_.x[a] + body.U.x[a]); });
    this->limit(body, place_, time + 0.5 * dt, 0.5 * dt, 0.5);
    this->hold(body, time + dt, 0.5);
  }

  std::vector<Vec<D>> place_; ///< where a stage's contact is judged, m
};

} // namespace tessera::solver
