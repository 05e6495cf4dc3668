/// Heun's method: the thesis' two-stage TVD Runge-Kutta step, (3.99).
#pragma once

#include "solver/time/advance.hpp"
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
  std::size_t own_bytes() const override { return this->outside_.walls.empty() ? 0 : sizeof(Vec<D>); }

  void prepare(Body& body, double) override {
    if (!this->outside_.walls.empty())
      place_ = body.U.x;
  }

  void take(Body& body, double time, double dt) override {
    auto& U = body.U;
    auto& R = body.R;
    const auto& U_n = this->before_;

    body.rates();
    this->conserve(body, U.x);
    this->load(body, U.x, time, dt, 0.5);
    note_all(body, 0.5 * dt);
    advance(U, dt, R);
    hold_middle(body, time, dt);
    body.stresses();

    body.rates();
    if (this->pushed())
      place_ = U.x;
    average(U.x, U_n.x, dt, R.x);
    this->conserve(body, U.x);
    this->load(body, place_, time + dt, dt, 0.5);
    note_all(body, 0.5 * dt);
    average(U.p, U_n.p, dt, R.p);
    average_strains(U, U_n, dt, R);
    this->limit(body, U.x, time + dt, dt);
    this->hold(body, time + dt);
    body.commit();
  }

  void note_all(const Body& body, double dt) {
    this->note(body, dt);
    if constexpr (Body::Formulation::evolves_J)
      this->note_J(body, dt);
    if constexpr (Body::Formulation::evolves_H)
      this->note_H(body, dt);
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
