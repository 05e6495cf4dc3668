/// What a step is, whatever its method: conditions from outside, momentum projection, the ledger of work.
#pragma once

#include "solver/boundary/conditions.hpp"
#include "solver/physics/body.hpp"
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
    std::swap(before_, body.U); // all of U is written anew, beside U^n
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
  /// From U^n, in before_, to U^(n+1), histories and all; U is anything before.
  virtual void take(Body& body, double time, double dt) = 0;

  /// Makes the nodal forces self-equilibrated about Gamma and the dissipation of J free of net volume,
  /// (3.120).
  void conserve(Body& body, const std::vector<Vec<D>>& Gamma) const {
    if (!projects_)
      return;
    project_momentum<D>(body.R.p, Gamma, body.V);
    if constexpr (Body::nets_J)
      project_volume(body.R.J, body.V);
  }

  /// Loads on the body as it is strained, at `time`.
  void load(const Body& body, const StrainFields<D>& strains, double time) {
    if (!loaded_)
      return;
    for_each(body.size(), [&](std::int64_t a) { force_[a].setZero(); });
    for (const auto& load : outside_.loads)
      load->add({outside_.X, body.V, body.density, strains, time}, force_);
  }
  /// They, and walls that push particles at x of the momenta p, on the rates: the projection must not see
  /// them. Walls note `share` dt of theirs.
  void act(Body& body, const std::vector<Vec<D>>& x, const std::vector<Vec<D>>& p, double time, double dt,
           double share) {
    if (!loaded_)
      return;
    for_each(body.size(), [&](std::int64_t a) { body.R.p[a] += force_[a]; });
    for (Wall<D>& wall : outside_.walls)
      wall.push(x, p, body.density, time, dt, share, body.R.p, force_);
  }

  /// Notes the impulse of a particle's rates over dt: the numerical part, which is not the divergence of P,
  /// and that of forces from outside.
  void note(const Body& body, std::int64_t a, double dt) {
    if (!loaded_) {
      numerical_[a] += dt * (body.R.p[a] - body.T[a]);
    } else {
      numerical_[a] += dt * (body.R.p[a] - body.T[a] - force_[a]);
      external_impulse_[a] += dt * force_[a];
    }
  }
  /// Notes by how much J and H change beyond what the motion asks for.
  void note_J(std::int64_t a, double change) { numerical_J_[a] += change; }
  void note_H(std::int64_t a, const Mat3& change) { numerical_H_[a] += change; }

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
  /// Impulse times mean velocity is exactly the kinetic energy an impulse brings. All impulses begin anew.
  void account(const Body& body) {
    const auto work_of = [&](std::vector<Vec<D>>& impulse) {
      return sum(body.size(), 0.0, [&](std::int64_t a) {
        const double work = body.V[a] * impulse[a].dot(before_.p[a] + body.U.p[a]) / (2 * body.density);
        impulse[a].setZero();
        return work;
      });
    };
    dissipated_ -= work_of(numerical_);
    if constexpr (Body::Formulation::evolves_J)
      dissipated_ -= stored_by_numerics(body);
    if (works_)
      external_ += work_of(external_impulse_);
  }

  /// J, by which the changes of H and J that are not the motion's have raised the stored energy: taken half
  /// way through the step, where they were made. They begin anew.
  double stored_by_numerics(const Body& body) {
    return sum(body.size(), 0.0, [&](std::int64_t a) {
      Strain less = Strain::of(embed(Mat<D>(0.5 * (before_.F[a] + body.U.F[a]))));
      less.J = 0.5 * (before_.J[a] + body.U.J[a] - numerical_J_[a]);
      Strain more = less;
      more.J += numerical_J_[a];
      numerical_J_[a] = 0;
      if constexpr (Body::Formulation::evolves_H) {
        less.H = 0.5 * (before_.H[a] + body.U.H[a] - numerical_H_[a]);
        more.H = less.H + numerical_H_[a];
        numerical_H_[a].setZero();
      }
      return body.V[a] * (body.material->energy(more, a) - body.material->energy(less, a));
    });
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
