/// One step of the mixed scheme: stages, momentum projection, conditions, and the ledger of work done.
#pragma once

#include "solver/boundary/fixed.hpp"
#include "solver/boundary/wall.hpp"
#include "solver/physics/body.hpp"
#include "solver/time/momentum_projection.hpp"
#include "solver/time/runge_kutta.hpp"

#include <utility>
#include <vector>

namespace tessera::solver {

template <class Body>
class Step {
 public:
  static constexpr int D = Body::dimension;

  Step(std::vector<Fixed<D>> fixed, std::vector<Wall<D>> walls, bool momentum_projection)
      : fixed_(std::move(fixed)), walls_(std::move(walls)), projects_(momentum_projection) {
    for (const Wall<D>& wall : walls_)
      pushes_ |= wall.law().method == ContactMethod::penalty;
  }

  double dissipated() const { return dissipated_; } ///< J, by JST and the momentum projection
  double external() const { return external_; }     ///< J, work done on the body by walls

  /// Conditions on the initial momenta; `dt` is the step to come.
  void start(Body& body, double dt) {
    numerical_.assign(body.V.size(), Vec<D>::Zero());
    if (!walls_.empty()) {
      contact_.assign(body.V.size(), Vec<D>::Zero());
      place_ = body.U.x;
    }
    for (const Fixed<D>& condition : fixed_)
      condition.apply(body.U.p);
    before_ = body.U;
    hold(body, body.U.x, 0, dt, 1.0);
    account(body);
  }

  /// U^n to U^(n+1). On Breakdown the body is back at U^n and the exception goes on.
  void operator()(Body& body, double dt) {
    auto& U = body.U;
    auto& R = body.R;
    before_ = U;
    try {
      body.rates();
      project(body, U.x, dt);
      push(body, before_.x, time_, dt);
      advance(U, dt, R);
      hold_middle(body, dt);
      body.stresses();

      body.rates();
      if (pushes_)
        place_ = U.x;
      average(U.x, before_.x, dt, R.x);
      project(body, U.x, dt);
      push(body, place_, time_ + dt, dt);
      average(U.p, before_.p, dt, R.p);
      average(U.F, before_.F, dt, R.F);
      hold(body, U.x, time_ + dt, dt, 1.0);
      body.commit();
    } catch (const Breakdown&) {
      body.U = before_;
      body.stresses();
      throw;
    }
    time_ += dt;
    account(body);
  }

 private:
  /// Makes the nodal forces self-equilibrated about Gamma, and notes what is not the divergence of P.
  void project(Body& body, const std::vector<Vec<D>>& Gamma, double dt) {
    if (projects_)
      project_momentum<D>(body.R.p, Gamma, body.V);
    for_each(body.size(), [&](std::int64_t a) { numerical_[a] += 0.5 * dt * (body.R.p[a] - body.T[a]); });
  }

  /// The first stage's momenta move a particle from the middle of x^n and x* to x^(n+1), in dt/2.
  void hold_middle(Body& body, double dt) {
    if (!walls_.empty())
      for_each(body.size(), [&](std::int64_t a) { place_[a] = 0.5 * (before_.x[a] + body.U.x[a]); });
    hold(body, place_, time_ + 0.5 * dt, 0.5 * dt, 0.5);
  }

  /// Essential conditions, and contact of particles at x, on the momenta of a stage; `share` of a change
  /// reaches U^(n+1).
  void hold(Body& body, const std::vector<Vec<D>>& x, double time, double dt, double share) {
    limit_by<D>(walls_, x, body.U.p, body.density, time, dt, share, contact_);
    for (const Fixed<D>& condition : fixed_)
      condition.apply(body.U.p);
  }

  /// Penalty forces of the walls on the rates of a stage whose positions are x.
  void push(Body& body, const std::vector<Vec<D>>& x, double time, double dt) {
    for (Wall<D>& wall : walls_)
      wall.push(x, body.U.p, body.density, time, dt, body.R.p, contact_);
  }

  /// Impulse times mean velocity is exactly the kinetic energy an impulse brings.
  void account(const Body& body) {
    const auto work_of = [&](std::vector<Vec<D>>& impulse) {
      const double work = sum(body.size(), 0.0, [&](std::int64_t a) {
        return body.V[a] * impulse[a].dot(before_.p[a] + body.U.p[a]) / (2 * body.density);
      });
      for_each(body.size(), [&](std::int64_t a) { impulse[a].setZero(); });
      return work;
    };
    dissipated_ -= work_of(numerical_);
    if (!walls_.empty())
      external_ += work_of(contact_);
  }

  std::vector<Fixed<D>> fixed_;
  std::vector<Wall<D>> walls_;
  bool projects_;
  bool pushes_ = false; ///< a wall is a penalty
  typename Body::Formulation before_;
  std::vector<Vec<D>> numerical_; ///< impulse of dissipation and projection in this step, kg/(m^2 s)
  std::vector<Vec<D>> contact_;   ///< impulse of the walls in this step, kg/(m^2 s)
  std::vector<Vec<D>> place_;     ///< where a stage's contact is judged
  double time_ = 0;               ///< s
  double dissipated_ = 0;
  double external_ = 0;
};

} // namespace tessera::solver
