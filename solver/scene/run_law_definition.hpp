/// Bodies of run_law and forecast_law, for the one source file of each law that instantiates them.
#pragma once

#include "core/interrupt.hpp"
#include "solver/scene/assemble.hpp"
#include "solver/scene/reporter.hpp"
#include "solver/scene/run_law.hpp"
#include "solver/time/stable_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tessera::solver {

inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Body>
Summary run_assembly(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                     Progress& progress, Assembly<Body>& assembly) {
  auto& [body, step, distance] = assembly;
  double dt = stable_step(body, scene.cfl, distance);
  step.start(body, dt);
  Reporter<Body> reporter(scene, cloud, outputs, assembly);

  Summary summary;
  summary.formulation = Body::Formulation::name;
  summary.scheme = scene.scheme;
  summary.particles = cloud.size();
  summary.neighbours_mean = body.neighbours.mean();
  summary.support = *std::max_element(body.neighbours.support.begin(), body.neighbours.support.end());
  summary.threads = threads();
  summary.bytes_per_particle = bytes_per_particle(body);
  summary.dt_min = summary.dt_max = dt;

  double time = 0;
  const double start = seconds_now();
  progress.begin("solve", scene.end_time);
  while (time < scene.end_time) {
    dt = stable_step(body, scene.cfl, distance);
    summary.dt_min = std::min(summary.dt_min, dt);
    summary.dt_max = std::max(summary.dt_max, dt);
    const bool last = time + dt >= scene.end_time;
    if (last)
      dt = scene.end_time - time;
    try {
      step(body, dt);
    } catch (const Breakdown& breakdown) {
      reporter.last(time, summary.steps, dt);
      const Vec3 X = cloud.X[breakdown.particle];
      throw RunError(
          fmt::format("{} at particle {} (reference position {:.4g}, {:.4g}, {:.4g} m)",
                      breakdown.J > 0 ? std::string("a field is no longer finite")
                                      : fmt::format("the volume ratio J is {:.3g}", breakdown.J),
                      breakdown.particle, X[0], X[1], X[2]),
          fmt::format("step {}, time {:.6g} s", summary.steps + 1, time),
          "the last good frame is written: lower solver.cfl, raise solver.jst4 or refine the particles");
    }
    time = last ? scene.end_time : time + dt;
    ++summary.steps;
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

template <class Body>
Forecast forecast_assembly(const SceneSpec& scene, Assembly<Body>& assembly) {
  auto& [body, step, distance] = assembly;
  Forecast forecast;
  forecast.mass = body.density * sum(body.size(), 0.0, [&](std::int64_t a) { return body.V[a]; });
  forecast.wave_speed = body.wave_speed;
  forecast.dt = stable_step(body, scene.cfl, distance);
  forecast.steps = static_cast<std::int64_t>(std::ceil(scene.end_time / forecast.dt));
  forecast.neighbours_mean = body.neighbours.mean();
  forecast.bytes_per_particle = bytes_per_particle(body);

  constexpr bool jst = decltype(body.dissipation)::active;
  const auto place = [&](bool present, const std::string& what, const std::string& why_not) {
    if (present)
      forecast.modelled.push_back(what);
    else
      forecast.left_out.push_back(what + " (" + why_not + ")");
  };
  place(true, fmt::format("{{p, F}} in {} dimensions, {}", Body::dimension, scene.material.law), "");
  place(scene.material.plasticity.has_value(), "von Mises plasticity", "no [material.plasticity]");
  place(jst, "JST dissipation", "solver.jst4 = 0");
  place(scene.momentum_projection, "momentum projection", "solver.momentum_projection = false");
  place(!scene.fixed.empty(), "fixed velocities", "no [[boundary]]");
  place(!scene.walls.empty(), "contact with rigid walls", "no [[wall]]");

  // A few real steps on this machine; the first warms the caches.
  step.start(body, forecast.dt);
  step(body, forecast.dt);
  constexpr int tried = 4;
  const double start = seconds_now();
  for (int i = 0; i < tried; ++i)
    step(body, forecast.dt);
  forecast.seconds = (seconds_now() - start) / tried * static_cast<double>(forecast.steps);
  return forecast;
}

template <class L>
Summary run_law(const L& law, const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                Progress& progress) {
  return with_dimension(scene, cloud, law, [&](auto& assembly) {
    return run_assembly(scene, cloud, outputs, progress, assembly);
  });
}

template <class L>
Forecast forecast_law(const L& law, const SceneSpec& scene, const ParticleCloud& cloud) {
  return with_dimension(scene, cloud, law,
                        [&](auto& assembly) { return forecast_assembly(scene, assembly); });
}

} // namespace tessera::solver
