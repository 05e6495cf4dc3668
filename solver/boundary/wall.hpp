/// Contact of a body with a rigid tool, and what it came to.
#pragma once

#include "core/parallel.hpp"
#include "core/rigid_shape.hpp"
#include "core/tensor.hpp"
#include "solver/boundary/plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tessera::solver {

enum class ContactMethod {
  reflection, ///< a constraint on the momenta
  penalty     ///< a spring and a dashpot behind the surface
};

/// How a body is treated where it meets a tool.
struct ContactLaw {
  ContactMethod method = ContactMethod::reflection;
  double friction = 0;    ///< Coulomb's coefficient, sticking and sliding alike
  double restitution = 0; ///< velocity of a particle's rebound over that of its impact
  double spring = 0;      ///< of the penalty: force per volume and depth, N/m^4
};

/// What a wall did to the body since the last report. In the plane forces are per metre of thickness.
template <int D>
struct ContactReport {
  Vec<D> force;             ///< on the body, friction included, mean over the time, N
  Vec<D> friction;          ///< the tangential part of it, N
  double largest_pressure;  ///< normal force of a particle over its own boundary area, where it has any, Pa
  std::int64_t touched = 0; ///< particles the wall acted on
};

/// Share of critical damping with which a spring and dashpot that cannot pull throw back a mass with the
/// restitution e: e = exp(-2 z acos z / sqrt(1 - z^2)), from the instant the force has fallen to zero.
/// Critical damping still gives exp(-2) = 0.135; below it, 1.
inline double damping_ratio(double restitution) {
  const auto rebound = [](double z) { return std::exp(-2 * z * std::acos(z) / std::sqrt(1 - z * z)); };
  double lower = 0, upper = 1;
  while (upper - lower > 1e-12) {
    const double middle = (lower + upper) / 2;
    (rebound(middle) > restitution ? lower : upper) = middle;
  }
  return upper;
}

/// A tool that moves with a constant velocity and the particles that meet it. Positions x in m, momenta p per
/// reference volume in kg/(m^2 s).
template <int D>
class Wall {
 public:
  /// `velocity` in m/s; the shape is where the tool is at time zero.
  Wall(std::string name, std::shared_ptr<const RigidShape> shape, const ContactLaw& law,
       const Vec<D>& velocity, std::size_t particles)
      : name_(std::move(name)), shape_(std::move(shape)), plane_(dynamic_cast<const Plane*>(shape_.get())),
        law_(law), velocity_(velocity), pressed_(particles, Vec<D>::Zero()) {
    if (law.friction > 0)
      dragged_.assign(particles, Vec<D>::Zero());
    if (law.method == ContactMethod::reflection && law.restitution > 0)
      incoming_.assign(particles, 0);
    if (plane_ == nullptr)
      seen_.assign(particles, {Vec<D>::Zero(), 0});
    damping_ = 2 * damping_ratio(law.restitution);
  }

  const std::string& name() const { return name_; }
  const ContactLaw& law() const { return law_; }

  /// Memory, a particle.
  std::size_t bytes() const {
    return (dragged_.empty() ? 1 : 2) * sizeof(Vec<D>) + (incoming_.empty() ? 0 : sizeof(double)) +
           (seen_.empty() ? 0 : sizeof(Seen));
  }

  /// Distance of x from the tool at a time, negative inside it, m.
  double distance(const Vec<D>& x, double time) const {
    return shape_->gap(in_space(x - time * velocity_)).distance;
  }

  /// Reflection, on the momenta of a stage of the time integration. These take the particle from x at `time`
  /// (s) to where it will be dt later: after the last stage in the next step, in the first of Heun's method
  /// from (x^n + x*) / 2 in half a step to x^(n+1), so that no position is ever behind the surface. One that
  /// would pass the surface within dt gets the normal velocity that just reaches it (Moreau's condition at
  /// velocity level); one that is behind it already gets no deeper. Velocities are relative to the tool's. In
  /// the last stage the restitution throws it back, with that times the velocity it came with in this step.
  /// The tangential momentum falls by at most the friction times the normal impulse, to zero and not beyond.
  ///
  /// `share` is the part of a change in this stage that reaches the end of the step, 1 in the last; that part
  /// is added to `impulse`. Returns how many particles were changed.
  std::int64_t limit(std::span<const Vec<D>> x, std::span<Vec<D>> p, double density, double time, double dt,
                     double share, std::span<Vec<D>> impulse) {
    if (law_.method != ContactMethod::reflection)
      return 0;
    const Moment now{density, dt, share, time * velocity_, density * velocity_};
    const auto each = [&](auto limited) {
      return sum(static_cast<std::int64_t>(x.size()), std::int64_t{0},
                 [&](std::int64_t a) -> std::int64_t { return limited(a) ? 1 : 0; });
    };
    if (plane_ != nullptr) {
      const Vec<D> up = plane_->normal().template head<D>();
      const double level = -plane_->gap(in_space(-now.moved)).distance, speed = up.dot(now.tool);
      const double landing_rate = density / dt;
      return each([&](std::int64_t a) {
        const double p_n = up.dot(p[a]) - speed;
        const double landing = -landing_rate * std::max(up.dot(x[a]) - level, 0.0);
        if (p_n >= landing && !came_in(a, now))
          return false;
        strike(a, up, std::max(landing - p_n, rebound(a, p_n, now)), p[a], now, impulse[a]);
        return true;
      });
    }
    return each([&](std::int64_t a) { return limit_at_surface(a, x[a], p[a], now, impulse[a]); });
  }

  /// Penalty, on the rates R of the momenta (N/m^3), which must hold all other forces already: a particle
  /// behind the surface is pushed out by spring times depth and braked by a dashpot that makes its rebound
  /// the restitution's, together never a pull. Friction is at most its coefficient times that force, and no
  /// more than brings the tangential momentum to zero within dt. The same is added to `force`. `share` is the
  /// part of dt that it acts for, which the report counts.
  void push(std::span<const Vec<D>> x, std::span<const Vec<D>> p, double density, double time, double dt,
            double share, std::span<Vec<D>> R, std::span<Vec<D>> force) {
    if (law_.method != ContactMethod::penalty)
      return;
    const double damping = damping_ * std::sqrt(law_.spring * density);
    for_each(static_cast<std::int64_t>(x.size()), [&](std::int64_t a) {
      const Vec<D> at = x[a] - time * velocity_;
      if (plane_ == nullptr && out_of_reach(a, at, 0))
        return;
      const RigidShape::Gap gap = gap_of(a, at);
      if (gap.distance >= 0)
        return;
      const Vec<D> n = gap.normal.template head<D>();
      const Vec<D> slip = p[a] - density * velocity_;
      const double push = std::max(0.0, -law_.spring * gap.distance - damping * n.dot(slip) / density);
      const Vec<D> drag = friction_on(slip + dt * R[a], n, dt * push) / dt;
      R[a] += push * n + drag;
      force[a] += push * n + drag;
      note(a, share * dt * push * n, share * dt * drag);
    });
  }

  /// Forces since the last report or the start, `elapsed` s ago; V the subvolumes (m^3), `area` the boundary
  /// area of each particle (m^2, 0 inside). Begins anew.
  ContactReport<D> report(std::span<const double> V, std::span<const double> area, double elapsed) {
    const auto n = static_cast<std::int64_t>(pressed_.size());
    const auto total = [&](const std::vector<Vec<D>>& impulses) -> Vec<D> {
      return sum(static_cast<std::int64_t>(impulses.size()), Vec<D>(Vec<D>::Zero()),
                 [&](std::int64_t a) -> Vec<D> { return V[a] * impulses[a]; });
    };
    ContactReport<D> report{Vec<D>::Zero(), Vec<D>::Zero(), 0};
    if (elapsed > 0) {
      report.friction = total(dragged_) / elapsed;
      report.force = total(pressed_) / elapsed + report.friction;
      report.largest_pressure = max_of(n, 0.0, [&](std::int64_t a) {
        return area[a] > 0 ? V[a] * pressed_[a].norm() / (area[a] * elapsed) : 0.0;
      });
    }
    report.touched = sum(n, std::int64_t{0},
                         [&](std::int64_t a) -> std::int64_t { return pressed_[a].isZero(0) ? 0 : 1; });
    std::fill(pressed_.begin(), pressed_.end(), Vec<D>::Zero());
    std::fill(dragged_.begin(), dragged_.end(), Vec<D>::Zero());
    return report;
  }

 private:
  struct Moment {
    double density, dt, share;
    Vec<D> moved, tool; ///< by the tool since time zero, m; momentum of what goes along with it, kg/(m^2 s)
    bool last() const { return share == 1; }
  };
  /// Where a particle was, as the tool sees it, when its distance was last found. It need not be found again
  /// before the particle has moved as far.
  struct Seen {
    Vec<D> x;
    double distance;
  };

  static Vec3 in_space(const Vec<D>& x) {
    Vec3 y = Vec3::Zero();
    y.template head<D>() = x;
    return y;
  }

  bool out_of_reach(std::int64_t a, const Vec<D>& at, double squared_travel) const {
    const Seen& seen = seen_[a];
    // (moved + travel)^2 <= 2 (moved^2 + travel^2)
    return seen.distance > 0 &&
           2 * ((at - seen.x).squaredNorm() + squared_travel) < seen.distance * seen.distance;
  }

  RigidShape::Gap gap_of(std::int64_t a, const Vec<D>& at) {
    if (plane_ != nullptr)
      return plane_->gap(in_space(at));
    const RigidShape::Gap gap = shape_->gap(in_space(at));
    seen_[a] = {at, gap.distance};
    return gap;
  }

  /// By where the particle would be after dt: around a corner the surface there counts, and in
  /// a corner two of its sides do, one after the other.
  bool limit_at_surface(std::int64_t a, const Vec<D>& x, Vec<D>& p, const Moment& now, Vec<D>& impulse) {
    const Vec<D> at = x - now.moved;
    const auto travel = [&]() -> Vec<D> { return now.dt * (p / now.density - velocity_); };
    const double squared_travel = travel().squaredNorm();
    const bool thrown_back = came_in(a, now);
    if (!thrown_back && out_of_reach(a, at, squared_travel))
      return false;
    const RigidShape::Gap here = gap_of(a, at);
    if (!thrown_back && here.distance > 0 && here.distance * here.distance > squared_travel)
      return false;
    // A chord along a convex tool dips into it by far less than its length; this much leads out again.
    constexpr double chord = 0.05;
    const double lowest = std::min(here.distance + chord * std::sqrt(squared_travel), 0.0);
    bool changed = false;
    constexpr int sides = 3;
    for (int side = 0; side < sides; ++side) {
      const Vec<D> way = travel();
      const RigidShape::Gap there = shape_->gap(in_space(at + way));
      const double missing = lowest - there.distance; // m
      const bool passes = missing > 1e-12 * way.norm();
      const bool throws = side == 0 && thrown_back;
      if (!passes && !throws)
        break;
      const Vec<D> n = (passes ? there : here).normal.template head<D>();
      const double p_n = n.dot(p - now.tool);
      strike(a, n, std::max(passes ? now.density * missing / now.dt : 0.0, rebound(a, p_n, now)), p, now,
             impulse);
      changed = true;
    }
    return changed;
  }

  /// Whether an earlier stage of this step stopped the particle and it is to be thrown back now.
  bool came_in(std::int64_t a, const Moment& now) const {
    return !incoming_.empty() && now.last() && incoming_[a] < 0;
  }

  /// The normal impulse that throws a particle back, zero but in the last stage; earlier ones remember how
  /// fast it came.
  double rebound(std::int64_t a, double p_n, const Moment& now) {
    if (incoming_.empty())
      return 0;
    const double came = std::min({incoming_[a], p_n, 0.0});
    incoming_[a] = now.last() ? 0 : came;
    return now.last() ? std::max(-law_.restitution * came - p_n, 0.0) : 0;
  }

  /// Gives the normal impulse j >= 0 and the friction that goes with it.
  void strike(std::int64_t a, const Vec<D>& n, double j, Vec<D>& p, const Moment& now, Vec<D>& impulse) {
    const Vec<D> drag = friction_on(p - now.tool, n, j);
    p += j * n + drag;
    impulse += now.share * (j * n + drag);
    note(a, now.share * j * n, now.share * drag);
  }

  /// The tangential impulse beside a normal one of j on a particle of this momentum relative to the tool.
  Vec<D> friction_on(const Vec<D>& slip, const Vec<D>& n, double j) const {
    if (law_.friction == 0)
      return Vec<D>::Zero();
    const Vec<D> along = slip - n.dot(slip) * n;
    const double size = along.norm();
    return size > 0 ? Vec<D>(-std::min(law_.friction * j / size, 1.0) * along) : Vec<D>(Vec<D>::Zero());
  }

  void note(std::int64_t a, const Vec<D>& normal, const Vec<D>& tangential) {
    pressed_[a] += normal;
    if (law_.friction > 0)
      dragged_[a] += tangential;
  }

  std::string name_;
  std::shared_ptr<const RigidShape> shape_;
  const Plane* plane_; ///< the shape where it is one: nearer at hand than any memory of it
  ContactLaw law_;
  Vec<D> velocity_;
  double damping_;               ///< of the dashpot over sqrt(spring density)
  std::vector<Vec<D>> pressed_;  ///< normal impulse since the last report, kg/(m^2 s)
  std::vector<Vec<D>> dragged_;  ///< tangential impulse since then; empty without friction
  std::vector<double> incoming_; ///< normal momentum a particle was stopped at in this step; empty where
                                 ///< nothing is thrown back
  std::vector<Seen> seen_;       ///< empty where the shape is a plane
};

/// Limits the momenta of a stage by every wall, again while a wall's action may have upset another's, at most
/// three times.
template <int D>
void limit_by(std::vector<Wall<D>>& walls, std::span<const Vec<D>> x, std::span<Vec<D>> p, double density,
              double time, double dt, double share, std::span<Vec<D>> impulse) {
  constexpr int sweeps = 3;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::int64_t changed = 0;
    for (Wall<D>& wall : walls)
      changed += wall.limit(x, p, density, time, dt, share, impulse);
    if (changed == 0 || walls.size() < 2)
      return;
  }
}

} // namespace tessera::solver
