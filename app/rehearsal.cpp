#include "app/rehearsal.hpp"

#include "core/cost.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "preprocess/cloud/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::app {
namespace {

constexpr double budget = 3;           ///< processor time of all runs together, s
constexpr double coarsest_finesse = 2; ///< two particles an edge: nothing to squeeze between them

/// What the steps of a run need: nothing is looked at.
solver::SceneSpec unobserved(solver::SceneSpec scene) {
  scene.probes.clear();
  scene.exact.reset();
  scene.fields.clear();
  scene.frames = scene.history_rows = 1;
  return scene;
}

/// The most by which waves may be slowed down: motions stay at a hundredth of their speed, and they cross the
/// body fifty times. 1 where loads drive the motion, or nothing is known to.
double most_slowed(const solver::SceneSpec& scene, const ParticleCloud& cloud,
                   const solver::Forecast& forecast) {
  using Kind = solver::BoundaryCondition::Kind;
  const bool loaded = std::any_of(scene.boundary.begin(), scene.boundary.end(), [](const auto& c) {
    return c.kind == Kind::traction || c.kind == Kind::pressure || c.kind == Kind::body_force;
  });
  if (loaded || forecast.fastest_motion == 0)
    return 1;
  constexpr double mach = 0.01, crossings = 50;
  Vec3 lower = cloud.X[0], upper = cloud.X[0];
  for (const Vec3& X : cloud.X) {
    lower = lower.cwiseMin(X);
    upper = upper.cwiseMax(X);
  }
  return std::max(1.0, std::min(mach * forecast.wave_speed / forecast.fastest_motion,
                                scene.end_time * forecast.wave_speed / ((upper - lower).norm() * crossings)));
}

/// Follows the time and the steps of a run.
class Follower {
 public:
  Follower(double end_time, double seconds) : end_(end_time), seconds_(seconds) {}

  /// After every step; whether it has been enough.
  bool operator()(double time, std::int64_t steps) {
    time_ = time;
    steps_ = steps;
    const double now = cpu_seconds();
    if (steps == 0)
      began_ = now;
    if (steps == 1)
      first_dt_ = time;
    if (steps == warm)
      warm_ = now;
    if (steps == warm + first)
      first_cost_ = (now - warm_) / first;
    cost_ = now - began_;
    if (steps >= 2 * mark_steps_) { // the later half of the steps says how it goes on
      before_ = mark_time_;
      before_steps_ = mark_steps_;
      mark_time_ = time;
      mark_steps_ = std::max<std::int64_t>(steps, 1);
    }
    return cost_ > seconds_;
  }

  Rehearsed result() const {
    Rehearsed r;
    r.reached = time_ / end_;
    r.cpu_seconds = cost_;
    double steps = static_cast<double>(steps_);
    if (time_ < end_ && time_ > before_)
      steps += (end_ - time_) * static_cast<double>(steps_ - before_steps_) / (time_ - before_);
    r.slowing = std::max(1.0, steps * first_dt_ / end_);
    if (steps_ > 4 * (warm + first) && first_cost_ > 0)
      r.costlier = std::clamp(cost_ / static_cast<double>(steps_) / first_cost_, 0.8, 3.0);
    return r;
  }

 private:
  static constexpr std::int64_t warm = 5, first = 30;

  double end_, seconds_;
  double time_ = 0, first_dt_ = 0, began_ = 0, warm_ = 0, first_cost_ = 0, cost_ = 0;
  std::int64_t steps_ = 0;
  double before_ = 0, mark_time_ = 0;
  std::int64_t before_steps_ = 0, mark_steps_ = 0;
};

Rehearsed run_once(const solver::SceneSpec& scene, const ParticleCloud& cloud, double seconds) {
  std::string broken_down;
  Follower follower(scene.end_time, seconds);
  solver::Outputs outputs;
  outputs.enough = [&](double time, std::int64_t steps) { return follower(time, steps); };
  try {
    solver::run(scene, cloud, outputs, Progress::silent());
  } catch (const RunError& e) {
    stop_if_interrupted("rehearsal");
    broken_down = e.what();
  }
  Rehearsed r = follower.result();
  r.particles = cloud.size();
  r.finesse = std::pow(static_cast<double>(cloud.size()), 1.0 / cloud.dimension);
  r.broken_down = broken_down;
  return r;
}

} // namespace

double expected_slowing(const std::vector<Rehearsed>& runs, double finesse) {
  double n = 1, x = coarsest_finesse, y = 1, xx = x * x, xy = x;
  for (const Rehearsed& run : runs) {
    n += 1;
    x += run.finesse;
    y += run.slowing;
    xx += run.finesse * run.finesse;
    xy += run.finesse * run.slowing;
  }
  const double spread = xx / n - x / n * x / n;
  const double slope = spread > 0 ? (xy / n - x / n * y / n) / spread : 0;
  return std::max(1.0, y / n + slope * (finesse - x / n));
}

Rehearsal rehearse(const Case& the_case, const solver::SceneSpec& scene, const preprocess::Domain& domain,
                   const ParticleCloud& cloud, const solver::Forecast& forecast, Progress& progress) {
  constexpr std::int64_t coarsest = 100, finer = 3;
  const auto all = cloud.size();
  const double most = most_slowed(scene, cloud, forecast);
  const solver::SceneSpec bare = unobserved(scene);
  Rehearsal rehearsal;
  double spent = 0;
  // By the steps that the first one's length makes; what is known of the others comes on top.
  const auto cost_of = [&](std::int64_t particles) {
    const double share = static_cast<double>(particles) / static_cast<double>(all);
    const double finesse = std::pow(static_cast<double>(particles), 1.0 / cloud.dimension);
    return forecast.step_cpu_seconds * static_cast<double>(forecast.steps) *
           std::pow(share, 1 + 1.0 / cloud.dimension) * expected_slowing(rehearsal.runs, finesse);
  };
  for (std::int64_t particles = coarsest;; particles *= finer) {
    const bool itself = particles * 3 / 2 >= all;
    particles = itself ? all : particles;
    const double slowed = std::clamp(cost_of(particles) / (budget / 3), 1.0, most);
    if (!rehearsal.runs.empty() && spent + cost_of(particles) / slowed > budget)
      break;
    solver::SceneSpec small = bare;
    small.material.density *= slowed * slowed;
    progress.note(fmt::format("rehearsal with {} particles", particles));
    try {
      preprocess::ParticleRequest request = the_case.particles;
      request.spacing = 0;
      request.count = particles;
      Rehearsed run =
          run_once(small, itself ? cloud : preprocess::prepare(domain, request, Progress::silent()).cloud,
                   2 * budget - spent);
      run.heavier = slowed * slowed;
      spent += run.cpu_seconds;
      rehearsal.runs.push_back(run);
    } catch (const InputError&) {
      stop_if_interrupted("rehearsal"); // too coarse for the body's shape, its sets or its neighbours
    }
    if (itself || spent > budget)
      break;
  }
  if (!rehearsal.runs.empty()) {
    const Rehearsed& finest = rehearsal.runs.back();
    rehearsal.slowing =
        finest.particles == all
            ? finest.slowing
            : expected_slowing(rehearsal.runs, std::pow(static_cast<double>(all), 1.0 / cloud.dimension));
    rehearsal.costlier = finest.costlier;
  }
  return rehearsal;
}

} // namespace tessera::app
