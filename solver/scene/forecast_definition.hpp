/// The body of forecast_formulation, for the one source file of each formulation that instantiates it.
#pragma once

#include "core/cost.hpp"
#include "core/error.hpp"
#include "solver/scene/assemble.hpp"
#include "solver/scene/explain.hpp"
#include "solver/scene/reporter.hpp"
#include "solver/scene/run_formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tessera::solver {

template <class Body>
BodyTraits traits_of(const SceneSpec& scene, const Body& body, const StepChoice& step) {
  using Formulation = typename Body::Formulation;
  const bool residual = chosen_dissipation(scene) == "linear_residual";
  BodyTraits traits;
  traits.dimension = Body::dimension;
  traits.formulation = Formulation::name;
  traits.title = Formulation::title;
  traits.evolves_F = Formulation::evolves_F;
  traits.evolves_H = Formulation::evolves_H;
  traits.evolves_J = Formulation::evolves_J;
  traits.dissipates = Body::dissipates;
  traits.dissipates_J = Body::dissipates_J;
  if constexpr (requires { body.dissipation.laplacian; })
    traits.blind = body.dissipation.laplacian.blind;
  traits.kappa = residual ? chosen_residual<Formulation>(scene) : chosen_kappa4<Formulation>(scene);
  traits.kappa_J = residual ? chosen_residual_J(scene) : chosen_kappa4_J(scene);
  traits.support = *std::max_element(body.neighbours.support.begin(), body.neighbours.support.end());
  traits.smallest_distance = step.by_wave * body.fastest_wave();
  return traits;
}

/// The same scene's bytes a particle in every formulation.
template <class Body>
void list_bytes(const SceneSpec& scene, const Assembly<Body>& assembly, Forecast& forecast) {
  const MemoryNeeds needs = memory_needs(scene, assembly);
  const auto bytes = [&]<class Formulation>() {
    with_dissipation<Formulation>(scene, [&]<class Dissipation>() {
      forecast.bytes_by_formulation.emplace_back(Formulation::name,
                                                 bytes_per_particle<Formulation, Dissipation>(needs));
    });
  };
  constexpr int D = Body::dimension;
  bytes.template operator()<Displacement<D>>();
  bytes.template operator()<PF<D>>();
  bytes.template operator()<PFJ<D>>();
  bytes.template operator()<PFHJ<D>>();
}

/// Runs as run_assembly does, for half a second at most and not beyond the run's end. Batches, because a busy
/// machine makes some of them slow.
template <class Body>
void time_steps(const SceneSpec& scene, Assembly<Body>& assembly, Forecast& forecast) {
  auto& body = assembly.body;
  auto& step = *assembly.step;
  constexpr double long_enough = 0.5, batch_seconds = 0.02;
  constexpr std::size_t fewest = 3;
  std::vector<double> cpu, wall;
  double time = 0;
  const double began = wall_seconds();
  try {
    for (bool warm = false;
         time < scene.end_time && (wall_seconds() - began < long_enough || cpu.size() < fewest);
         warm = true) {
      const double cpu_before = cpu_seconds(), wall_before = wall_seconds();
      int taken = 0;
      do {
        const double dt = std::min(assembly.limit(body), scene.end_time - time);
        step(body, time, dt);
        time += dt;
        ++taken;
      } while (time < scene.end_time && wall_seconds() - wall_before < batch_seconds);
      if (!warm && time < scene.end_time) // the first batch fills the caches
        continue;
      cpu.push_back((cpu_seconds() - cpu_before) / taken);
      wall.push_back((wall_seconds() - wall_before) / taken);
    }
  } catch (const Breakdown& breakdown) {
    if (cpu.empty())
      throw RunError(fmt::format("the first steps break down: the volume ratio J is {:.3g} at particle {}",
                                 breakdown.J, breakdown.particle),
                     fmt::format("time {:.6g} s", time), "lower solver.cfl or refine the particles");
  }
  const auto median = [](std::vector<double>& x) {
    std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
    return x[x.size() / 2];
  };
  forecast.step_cpu_seconds = median(cpu);
  forecast.step_seconds = median(wall);
}

/// What a row and a frame of the body as it is cost.
template <class Body>
void time_outputs(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                  Assembly<Body>& assembly, Forecast& forecast) {
  constexpr int tried = 3;
  const auto seconds = [&](const Outputs& of) {
    Reporter<Body> reporter(scene, cloud, of, assembly);
    const double began = wall_seconds();
    for (int i = 1; i <= tried; ++i)
      reporter.last(0, i, forecast.dt);
    return (wall_seconds() - began) / tried;
  };
  Outputs rows;
  rows.history_row = [](const std::vector<double>&) {};
  forecast.row_seconds = seconds(rows);
  rows.frame = outputs.frame;
  if (outputs.frame)
    forecast.frame_seconds = std::max(seconds(rows) - forecast.row_seconds, 0.0);
}

/// The largest speed that is given, m/s: at the start, of held sets over the time, of walls.
template <class Body>
double fastest_given_motion(const SceneSpec& scene, const ParticleCloud& cloud, const Body& body) {
  double fastest = max_of(body.size(), 0.0, [&](std::int64_t a) { return body.velocity(a).norm(); });
  for (const WallSpec& wall : scene.walls)
    fastest = std::max(fastest, wall.velocity.norm());
  constexpr int instants = 20;
  for (const BoundaryCondition& c : scene.boundary)
    if (c.kind == BoundaryCondition::Kind::velocity)
      for (std::int32_t a : cloud.set(c.on, "boundary").particles)
        for (int i = 0; i <= instants; ++i) {
          Vec3 v;
          for (int k = 0; k < 3; ++k)
            v[k] = c.component[static_cast<std::size_t>(k)]
                       ? c.values[static_cast<std::size_t>(k)](cloud.X[a], scene.end_time * i / instants)
                       : 0;
          fastest = std::max(fastest, v.norm());
        }
  return fastest;
}

/// `began`: cpu_seconds() before anything was set up.
template <class Body>
Forecast forecast_assembly(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                           Assembly<Body>& assembly, double began) {
  auto& body = assembly.body;
  Forecast forecast;
  forecast.mass = body.density * sum(body.size(), 0.0, [&](std::int64_t a) { return body.V[a]; });
  forecast.wave_speed = body.wave_speed;
  forecast.dt = assembly.limit(body);
  forecast.step = step_choice(assembly.limit.bounds(body));
  assembly.step->start(body, forecast.dt);
  forecast.setup_seconds = cpu_seconds() - began;
  forecast.fastest_motion = fastest_given_motion(scene, cloud, body);
  forecast.steps = static_cast<std::int64_t>(std::ceil(scene.end_time / forecast.dt));
  forecast.neighbours_mean = body.neighbours.mean();
  forecast.bytes_per_particle = bytes_of(scene, assembly);
  list_bytes(scene, assembly, forecast);
  explain(scene, cloud, traits_of(scene, body, forecast.step), forecast);
  time_steps(scene, assembly, forecast);
  time_outputs(scene, cloud, outputs, assembly, forecast);
  return forecast;
}

template <class Formulation>
Forecast forecast_formulation(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs) {
  const double began = cpu_seconds();
  return with_assembly<Formulation>(scene, cloud, [&](auto& assembly) {
    return forecast_assembly(scene, cloud, outputs, assembly, began);
  });
}

} // namespace tessera::solver
