/// One step of the mixed scheme: stages, momentum projection, conditions, and the ledger of work done.
#pragma once

#include "solver/boundary/held_velocity.hpp"
#include "solver/boundary/loads.hpp"
#include "solver/boundary/wall.hpp"
#include "solver/physics/body.hpp"
#include "solver/time/momentum_projection.hpp"
#include "solver/time/runge_kutta.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace tessera::solver {

/// What acts on a body from outside.
template <int D>
struct Conditions {
  std::vector<Vec3> X; ///< reference positions, m
  HeldVelocities<D> held;
  std::vector<std::unique_ptr<Load<D>>> loads;
  std::vector<Wall<D>> walls;
};

template <class Body>
class Step {
 public:
  static constexpr int D = Body::dimension;

  Step(Conditions<D> conditions, bool momentum_projection)
      : outside_(std::move(conditions)), projects_(momentum_projection),
        works_(!outside_.walls.empty() || !outside_.loads.empty() || outside_.held.moving()) {
    for (const Wall<D>& wall : outside_.walls)
      pushes_ |= wall.law().method == ContactMethod::penalty;
  }

  double dissipated() const { return dissipated_; } ///< J, by JST and the momentum projection
  double external() const { return external_; }     ///< J, work done on the body from outside

  bool works() const { return works_; } ///< whether anything outside may work on the body
  std::vector<Wall<D>>& walls() { return outside_.walls; }

  /// Conditions on the initial momenta; `dt` is the step to come.
  void start(Body& body, double dt) {
    numerical_.assign(body.V.size(), Vec<D>::Zero());
    if (works_)
      external_impulse_.assign(body.V.size(), Vec<D>::Zero());
    if (!outside_.walls.empty())
      place_ = body.U.x;
    if (!outside_.loads.empty())
      force_.assign(body.V.size(), Vec<D>::Zero());
    outside_.held.apply(body.U.p, body.density, 0, 0, external_impulse_);
    before_ = body.U;
    hold(body, body.U.x, 0, dt);
    account(body);
  }

  /// U^n to U^(n+1), from `time` over dt. On Breakdown the body is back at U^n and the exception goes on.
  void operator()(Body& body, double time, double dt) {
    auto& U = body.U;
    auto& R = body.R;
    before_ = U;
    try {
      body.rates();
      conserve(body, U.x, dt);
      load(body, U.x, time, dt);
      advance(U, dt, R);
      hold_middle(body, time, dt);
      body.stresses();

      body.rates();
      if (pushes_)
        place_ = U.x;
      average(U.x, before_.x, dt, R.x);
      conserve(body, U.x, dt);
      load(body, place_, time + dt, dt);
      average(U.p, before_.p, dt, R.p);
      average_strains(U, before_, dt, R);
      hold(body, U.x, time + dt, dt);
      body.commit();
    } catch (const Breakdown&) {
      body.U = before_;
      body.stresses();
      throw;
    }
    account(body);
  }

 private:
  /// Makes the nodal forces self-equilibrated about Gamma and the dissipation of J free of net volume,
  /// (3.120); notes what is not the divergence of P.
  void conserve(Body& body, const std::vector<Vec<D>>& Gamma, double dt) {
    if (projects_) {
      project_momentum<D>(body.R.p, Gamma, body.V);
      if constexpr (Body::nets_J)
        project_volume(body.R.J, body.dissipation.rate_J, body.V);
    }
    for_each(body.size(), [&](std::int64_t a) { numerical_[a] += 0.5 * dt * (body.R.p[a] - body.T[a]); });
  }

  /// Forces from outside on the rates of a stage whose positions are x: the projection must not see them.
  void load(Body& body, const std::vector<Vec<D>>& x, double time, double dt) {
    if (!outside_.loads.empty()) {
      for_each(body.size(), [&](std::int64_t a) { force_[a].setZero(); });
      for (const auto& load : outside_.loads)
        load->add({outside_.X, body.V, body.density, body.strains(), time}, force_);
      for_each(body.size(), [&](std::int64_t a) {
        body.R.p[a] += force_[a];
        external_impulse_[a] += 0.5 * dt * force_[a];
      });
    }
    for (Wall<D>& wall : outside_.walls)
      wall.push(x, body.U.p, body.density, time, dt, body.R.p, external_impulse_);
  }

  /// The first stage's momenta move a particle from the middle of x^n and x* to x^(n+1), in dt/2.
  void hold_middle(Body& body, double time, double dt) {
    if (!outside_.walls.empty())
      for_each(body.size(), [&](std::int64_t a) { place_[a] = 0.5 * (before_.x[a] + body.U.x[a]); });
    limit_by<D>(outside_.walls, place_, body.U.p, body.density, time + 0.5 * dt, 0.5 * dt, 0.5,
                external_impulse_);
    outside_.held.apply(body.U.p, body.density, time + dt, 0.5, external_impulse_);
  }

  /// Contact of particles at x, and essential conditions, on the momenta of the last stage.
  void hold(Body& body, const std::vector<Vec<D>>& x, double time, double dt) {
    limit_by<D>(outside_.walls, x, body.U.p, body.density, time, dt, 1.0, external_impulse_);
    outside_.held.apply(body.U.p, body.density, time, 1.0, external_impulse_);
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
    if (works_)
      external_ += work_of(external_impulse_);
  }

  Conditions<D> outside_;
  bool projects_;
  bool works_;
  bool pushes_ = false; ///< a wall is a penalty
  typename Body::Formulation before_;
  std::vector<Vec<D>> force_;            ///< of the loads, N/m^3
  std::vector<Vec<D>> place_;            ///< where a stage's contact is judged
  std::vector<Vec<D>> numerical_;        ///< impulse of dissipation and projection in this step, kg/(m^2 s)
  std::vector<Vec<D>> external_impulse_; ///< of walls, loads and moving boundaries in this step, kg/(m^2 s)
  double dissipated_ = 0;
  double external_ = 0;
};

} // namespace tessera::solver
