/// Bodies of run_formulation and forecast_formulation, for the one source file of each formulation that
/// instantiates them.
#pragma once

#include "core/cost.hpp"
#include "core/interrupt.hpp"
#include "solver/scene/assemble.hpp"
#include "solver/scene/reporter.hpp"
#include "solver/scene/run_formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tessera::solver {

inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline StepChoice step_choice(const StepBounds& bounds) {
  return {bounds.by_wave, bounds.critical, bounds.critical_binds ? "critical" : "wave"};
}

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
  summary.bytes_per_particle = bytes_of<Body>(assembly);
  summary.dt_min = summary.dt_max = dt;
  summary.step = step_choice(bounds);

  double time = 0;
  const double start = seconds_now();
  progress.begin("solve", scene.end_time);
  while (time < scene.end_time) {
    const double step_began = cpu_seconds();
    dt = limit(body);
    summary.dt_min = std::min(summary.dt_min, dt);
    summary.dt_max = std::max(summary.dt_max, dt);
    const bool last = time + dt >= scene.end_time;
    if (last)
      dt = scene.end_time - time;
    try {
      step(body, time, dt);
    } catch (const Breakdown& breakdown) {
      reporter.last(time, summary.steps, dt);
      const Vec3 X = cloud.X[breakdown.particle];
      throw RunError(
          fmt::format("{} at particle {} (reference position {:.4g}, {:.4g}, {:.4g} m)",
                      breakdown.J > 0 ? std::string("a field is no longer finite")
                                      : fmt::format("the volume ratio J is {:.3g}", breakdown.J),
                      breakdown.particle, X[0], X[1], X[2]),
          fmt::format("step {}, time {:.6g} s", summary.steps + 1, time),
          fmt::format(
              "the last good frame is written: lower solver.cfl, raise solver.{} or refine the particles",
              chosen_dissipation(scene) == "linear_residual" ? "residual" : "jst4"));
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
  summary.wall_seconds = seconds_now() - start;
  summary.us_per_particle_step =
      1e6 * summary.wall_seconds /
      (static_cast<double>(summary.steps) * static_cast<double>(summary.particles));
  summary.time = time;
  reporter.summarise(summary);
  progress.finish(fmt::format("{} steps", summary.steps));
  return summary;
}

/// What a scene models, and what it leaves out with the reason.
template <class Body>
void list_models(const SceneSpec& scene, const Body& body, Forecast& forecast) {
  const auto place = [&](bool present, const std::string& what, const std::string& why_not) {
    if (present)
      forecast.modelled.push_back(what);
    else
      forecast.left_out.push_back(fmt::format("{} ({})", what, why_not));
  };
  using Kind = BoundaryCondition::Kind;
  const auto any = [&](std::initializer_list<Kind> kinds) {
    return std::any_of(scene.boundary.begin(), scene.boundary.end(), [&](const BoundaryCondition& c) {
      return std::find(kinds.begin(), kinds.end(), c.kind) != kinds.end();
    });
  };
  using Formulation = typename Body::Formulation;
  place(true, fmt::format("{} in {} dimensions, {}", Formulation::title, Body::dimension, scene.material.law),
        "");
  place(scene.material.plasticity.has_value(), "von Mises plasticity", "no [material.plasticity]");
  place(is_consistent(scene), "balance of constant stresses", "solver.scheme = \"thesis\"");
  const std::string chosen = chosen_dissipation(scene);
  const bool residual = chosen == "linear_residual";
  const std::string dissipation = residual          ? "residual dissipation"
                                  : chosen == "jst" ? "JST dissipation"
                                                    : "symmetric JST dissipation";
  place(Body::dissipates, dissipation, residual ? "solver.residual = 0" : "solver.jst4 = 0");
  if constexpr (requires { body.dissipation.laplacian; })
    if (body.dissipation.laplacian.blind > 0)
      forecast.left_out.push_back(
          fmt::format("{} by {} particles (their neighbours lie on a sphere with them; "
                      "a wider solver.support)",
                      dissipation, body.dissipation.laplacian.blind));
  if (Body::dissipates && chosen == "jst")
    place(scene.jst2 > 0, "JST's shock term", "solver.jst2 = 0");
  if constexpr (Formulation::evolves_J) {
    place(Body::dissipates_J, dissipation + " of J",
          residual ? "solver.residual_J = 0" : "solver.jst4_J = 0");
    place(chosen_involution(scene) > 0, "involution penalty", "solver.involution = 0");
  }
  place(scene.momentum_projection, "momentum projection", "solver.momentum_projection = false");
  place(any({Kind::fixed, Kind::sliding, Kind::skew_symmetric}), "fixed velocities", "no such [[boundary]]");
  place(any({Kind::velocity}), "moving boundaries", "no such [[boundary]]");
  place(any({Kind::traction, Kind::pressure}), "surface loads", "no such [[boundary]]");
  place(any({Kind::body_force}), "body forces", "no such [[boundary]]");
  place(!scene.walls.empty(), "contact with rigid tools", "no [[wall]]");
  static_cast<void>(body);
}

template <class Body>
Forecast forecast_assembly(const SceneSpec& scene, Assembly<Body>& assembly) {
  auto& body = assembly.body;
  auto& step = *assembly.step;
  auto& limit = assembly.limit;
  Forecast forecast;
  forecast.mass = body.density * sum(body.size(), 0.0, [&](std::int64_t a) { return body.V[a]; });
  forecast.wave_speed = body.wave_speed;
  forecast.dt = limit(body);
  forecast.step = step_choice(limit.bounds(body));
  forecast.steps = static_cast<std::int64_t>(std::ceil(scene.end_time / forecast.dt));
  forecast.neighbours_mean = body.neighbours.mean();
  forecast.bytes_per_particle = bytes_of<Body>(assembly);
  const auto bytes = [&]<class Formulation>() {
    with_dissipation<Formulation>(scene, [&]<class Dissipation>() {
      forecast.bytes_by_formulation.emplace_back(
          Formulation::name, bytes_per_particle<Formulation, Dissipation>(
                                 body.neighbours.mean(), body.material->history_bytes(), step.works()));
    });
  };
  constexpr int D = Body::dimension;
  bytes.template operator()<Displacement<D>>();
  bytes.template operator()<PF<D>>();
  bytes.template operator()<PFJ<D>>();
  bytes.template operator()<PFHJ<D>>();
  list_models(scene, body, forecast);

  // A few real steps on this machine; the first warms the caches.
  step.start(body, forecast.dt);
  step(body, 0, forecast.dt);
  constexpr int tried = 4;
  const double start = seconds_now();
  for (int i = 1; i <= tried; ++i)
    step(body, i * forecast.dt, forecast.dt);
  forecast.seconds = (seconds_now() - start) / tried * static_cast<double>(forecast.steps);
  return forecast;
}

template <class Formulation>
Summary run_formulation(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                        Progress& progress) {
  const double began = cpu_seconds();
  return with_assembly<Formulation>(scene, cloud, [&](auto& assembly) {
    return run_assembly(scene, cloud, outputs, progress, assembly, began);
  });
}

template <class Formulation>
Forecast forecast_formulation(const SceneSpec& scene, const ParticleCloud& cloud) {
  return with_assembly<Formulation>(scene, cloud,
                                    [&](auto& assembly) { return forecast_assembly(scene, assembly); });
}

} // namespace tessera::solver
