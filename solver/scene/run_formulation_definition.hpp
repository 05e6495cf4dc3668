/// The body of run_formulation, for the one source file of each formulation that instantiates it.
#pragma once

#include "core/cost.hpp"
#include "core/interrupt.hpp"
#include "solver/scene/assemble.hpp"
#include "solver/scene/reporter.hpp"
#include "solver/scene/run_formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::solver {

/// Of the first step. A body that blows up without turning inside out takes its step along, and the run would
/// never end.
inline constexpr double collapsed = 1e-4;

/// `began`: cpu_seconds() before anything was set up.
template <class Body>
Summary run_assembly(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                     Progress& progress, Assembly<Body>& assembly, double began) {
  auto& body = assembly.body;
  auto& step = *assembly.step;
  auto& limit = assembly.limit;
  double dt = limit(body);
  const StepBounds bounds = limit.bounds(body);
  step.start(body, dt);
  Summary summary;
  summary.setup_seconds = cpu_seconds() - began;
  Reporter<Body> reporter(scene, cloud, outputs, assembly);

  summary.formulation = Body::Formulation::name;
  summary.scheme = scene.scheme;
  summary.dissipation = Body::dissipates ? chosen_dissipation(scene) : "none";
  summary.particles = cloud.size();
  summary.neighbours_mean = body.neighbours.mean();
  summary.support = *std::max_element(body.neighbours.support.begin(), body.neighbours.support.end());
  summary.threads = threads();
  summary.bytes_per_particle = bytes_of(scene, assembly);
  summary.dt_min = summary.dt_max = dt;
  summary.step = step_choice(bounds);

  double time = 0;
  const double start = wall_seconds(), first_dt = dt;
  const auto broken_off = [&](const std::string& what, std::int64_t particle) {
    reporter.last(time, summary.steps, dt);
    const Vec3 X = cloud.X[particle];
    return RunError(
        fmt::format("{} at particle {} (reference position {:.4g}, {:.4g}, {:.4g} m)", what, particle, X[0],
                    X[1], X[2]),
        fmt::format("step {}, time {:.6g} s", summary.steps + 1, time),
        fmt::format(
            "the last good frame is written: lower solver.cfl, raise solver.{} or refine the particles",
            chosen_dissipation(scene) == "linear_residual" ? "residual" : "jst4"));
  };
  progress.begin("solve", scene.end_time);
  const auto enough = [&] { return outputs.enough && outputs.enough(time, summary.steps); };
  while (time < scene.end_time && !enough()) {
    const double step_began = cpu_seconds();
    dt = limit(body);
    if (dt < collapsed * first_dt)
      throw broken_off(
          fmt::format("the step has shrunk from {:.3g} to {:.3g} s: waves are fastest", first_dt, dt),
          std::max_element(body.wave.begin(), body.wave.end()) - body.wave.begin());
    summary.dt_min = std::min(summary.dt_min, dt);
    summary.dt_max = std::max(summary.dt_max, dt);
    const bool last = time + dt >= scene.end_time;
    if (last)
      dt = scene.end_time - time;
    try {
      step(body, time, dt);
    } catch (const Breakdown& breakdown) {
      throw broken_off(breakdown.J > 0 ? std::string("a field is no longer finite")
                                       : fmt::format("the volume ratio J is {:.3g}", breakdown.J),
                       breakdown.particle);
    }
    time = last ? scene.end_time : time + dt;
    ++summary.steps;
    summary.cpu_seconds += cpu_seconds() - step_began;
    reporter.after_step(time, summary.steps, dt);
    progress.advance(time, fmt::format("step {}, dt {:.3g} s", summary.steps, dt));
    if (interrupted()) {
      reporter.last(time, summary.steps, dt);
      throw RunError("interrupted", fmt::format("step {}, time {:.6g} s", summary.steps, time),
                     "frames and history up to here are written");
    }
  }
  reporter.last(time, summary.steps, dt);
  summary.wall_seconds = wall_seconds() - start;
  summary.us_per_particle_step =
      1e6 * summary.wall_seconds /
      (static_cast<double>(summary.steps) * static_cast<double>(summary.particles));
  summary.time = time;
  reporter.summarise(summary);
  progress.finish(fmt::format("{} steps", summary.steps));
  return summary;
}

template <class Formulation>
Summary run_formulation(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                        Progress& progress) {
  const double began = cpu_seconds();
  return with_assembly<Formulation>(scene, cloud, [&](auto& assembly) {
    return run_assembly(scene, cloud, outputs, progress, assembly, began);
  });
}

} // namespace tessera::solver
