/// What a step is, whatever its method: conditions from outside, momentum projection, the ledger of work.
#pragma once

#include "solver/boundary/conditions.hpp"
#include "solver/physics/body.hpp"
#include "solver/time/advance.hpp"
#include "solver/time/momentum_projection.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace tessera::solver {

template <class Body>
class Step {
 public:
  static constexpr int D = Body::dimension;

  virtual ~Step() = default;

  /// J, by dissipation, the momentum projection and the penalty on H and J.
  double dissipated() const { return dissipated_; }
  double external() const { return external_; } ///< J, work done on the body from outside

  bool works() const { return works_; } ///< whether anything outside may work on the body
  std::vector<Wall<D>>& walls() { return outside_.walls; }
  HeldVelocities<D>& held() { return outside_.held; }

  /// Memory of what acts from outside, bytes a particle; zero where nothing does.
  std::size_t outside_bytes() const {
    std::size_t bytes =
        (works_ + loaded_) * sizeof(Vec<D>) + (outside_.X.empty() ? 0 : sizeof(Vec3)) + own_bytes();
    for (const Wall<D>& wall : outside_.walls)
      bytes += wall.bytes();
    return bytes;
  }

  /// Conditions on the initial momenta; `dt` is the step to come.
  void start(Body& body, double dt) {
    numerical_.assign(body.V.size(), Vec<D>::Zero());
    if constexpr (Body::Formulation::evolves_J)
      numerical_J_.assign(body.V.size(), 0.0);
    if constexpr (Body::Formulation::evolves_H)
      numerical_H_.assign(body.V.size(), Mat3::Zero());
    if (works_)
      external_impulse_.assign(body.V.size(), Vec<D>::Zero());
    if (loaded_)
      force_.assign(body.V.size(), Vec<D>::Zero());
    outside_.held.apply(body.U.p, body.density, 0, 0, external_impulse_);
    before_ = body.U;
    limit(body, body.U.x, 0, dt);
    hold(body, 0);
    account(body);
    prepare(body, dt);
  }

  /// U^n to U^(n+1), from `time` over dt. On Breakdown the body is back at U^n and the exception goes on.
  void operator()(Body& body, double time, double dt) {
    before_ = body.U;
    try {
      take(body, time, dt);
    } catch (const Breakdown&) {
      body.U = before_;
      body.stresses();
      throw;
    }
    account(body);
  }

 protected:
  Step(Conditions<D> conditions, bool momentum_projection)
      : outside_(std::move(conditions)), projects_(momentum_projection),
        works_(!outside_.walls.empty() || !outside_.loads.empty() || outside_.held.moving()),
        pushed_(std::any_of(outside_.walls.begin(), outside_.walls.end(),
                            [](const Wall<D>& wall) { return wall.law().method == ContactMethod::penalty; })),
        loaded_(pushed_ || !outside_.loads.empty()) {}

  /// Of them, bytes a particle that the method itself holds.
  virtual std::size_t own_bytes() const { return 0; }
  /// What the method needs before its first step.
  virtual void prepare(Body& body, double dt) = 0;
  /// U^n to U^(n+1), histories and all.
  virtual void take(Body& body, double time, double dt) = 0;

  /// Makes the nodal forces self-equilibrated about Gamma and the dissipation of J free of net volume,
  /// (3.120).
  void conserve(Body& body, const std::vector<Vec<D>>& Gamma) const {
    if (!projects_)
      return;
    project_momentum<D>(body.R.p, Gamma, body.V);
    if constexpr (Body::nets_J)
      project_volume(body.R.J, body.dissipation.rate_J, body.V);
  }

  /// Forces from outside on the rates, for positions x at `time`: the projection must not see them. Walls
  /// note `share` dt of theirs.
  void load(Body& body, const std::vector<Vec<D>>& x, double time, double dt, double share) {
    if (!loaded_)
      return;
    for_each(body.size(), [&](std::int64_t a) { force_[a].setZero(); });
    for (const auto& load : outside_.loads)
      load->add({outside_.X, body.V, body.density, body.strains(), time}, force_);
    for_each(body.size(), [&](std::int64_t a) { body.R.p[a] += force_[a]; });
    for (Wall<D>& wall : outside_.walls)
      wall.push(x, body.U.p, body.density, time, dt, share, body.R.p, force_);
  }

  /// Notes the impulse of the rates over dt: the numerical part, which is not the divergence of P, and that
  /// of forces from outside.
  void note(const Body& body, double dt) {
    if (!loaded_) {
      for_each(body.size(), [&](std::int64_t a) { numerical_[a] += dt * (body.R.p[a] - body.T[a]); });
      return;
    }
    for_each(body.size(), [&](std::int64_t a) {
      numerical_[a] += dt * (body.R.p[a] - body.T[a] - force_[a]);
      external_impulse_[a] += dt * force_[a];
    });
  }

  /// Notes by how much the rates of J change it over dt beyond what the motion asks for, H : G.
  void note_J(const Body& body, double dt) {
    for_each(body.size(), [&](std::int64_t a) {
      numerical_J_[a] += dt * (body.R.J[a] - body.strain(a).H.cwiseProduct(embed_rate(body.R.F[a])).sum());
    });
  }
  /// The same where the rates of J hold none of the motion's.
  void note_change_of_J(double dt, const std::vector<double>& rate) { advance(numerical_J_, dt, rate); }
  /// As note_J of H, beyond F x G.
  void note_H(const Body& body, double dt) {
    for_each(body.size(), [&](std::int64_t a) {
      numerical_H_[a] += dt * (body.R.H[a] - cross(embed(body.U.F[a]), embed_rate(body.R.F[a])));
    });
  }

  /// Contact and essential conditions on momenta that take the particles from x at `time` onwards over dt and
  /// of whose change the share reaches the end of the step.
  void limit(Body& body, const std::vector<Vec<D>>& x, double time, double dt, double share = 1) {
    limit_by<D>(outside_.walls, x, body.U.p, body.density, time, dt, share, external_impulse_);
  }
  void hold(Body& body, double time, double share = 1) {
    outside_.held.apply(body.U.p, body.density, time, share, external_impulse_);
  }

  bool pushed() const { return pushed_; } ///< by a penalty

  Conditions<D> outside_;
  typename Body::Formulation before_; ///< U^n

 private:
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
    if constexpr (Body::Formulation::evolves_J)
      dissipated_ -= stored_by_numerics(body);
    if (works_)
      external_ += work_of(external_impulse_);
  }

  /// J, by which the changes of H and J that are not the motion's have raised the stored energy: taken half
  /// way through the step, where they were made.
  double stored_by_numerics(const Body& body) {
    const double stored = sum(body.size(), 0.0, [&](std::int64_t a) {
      Strain less = Strain::of(embed(Mat<D>(0.5 * (before_.F[a] + body.U.F[a]))));
      less.J = 0.5 * (before_.J[a] + body.U.J[a] - numerical_J_[a]);
      Strain more = less;
      more.J += numerical_J_[a];
      if constexpr (Body::Formulation::evolves_H) {
        less.H = 0.5 * (before_.H[a] + body.U.H[a] - numerical_H_[a]);
        more.H = less.H + numerical_H_[a];
      }
      return body.V[a] * (body.material->energy(more, a) - body.material->energy(less, a));
    });
    std::fill(numerical_J_.begin(), numerical_J_.end(), 0.0);
    std::fill(numerical_H_.begin(), numerical_H_.end(), Mat3::Zero());
    return stored;
  }

  bool projects_;
  bool works_;
  bool pushed_;
  bool loaded_;                   ///< by loads or penalties
  std::vector<Vec<D>> force_;     ///< of them, N/m^3
  std::vector<Vec<D>> numerical_; ///< impulse of dissipation and projection in this step, kg/(m^2 s)
  std::vector<double>
      numerical_J_; ///< change of J in this step that is none of the motion's, where J is evolved
  std::vector<Mat3> numerical_H_;        ///< the same of H
  std::vector<Vec<D>> external_impulse_; ///< of walls, loads and moving boundaries in this step, kg/(m^2 s)
  double dissipated_ = 0;
  double external_ = 0;
};

} // namespace tessera::solver
