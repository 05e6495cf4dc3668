/// Cost of building the operators and of a step: nanoseconds per particle, on one thread and on all.
#include "core/parallel.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "solver/boundary/plane.hpp"
#include "solver/boundary/polyline.hpp"
#include "solver/boundary/wall.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/operators/gradient.hpp"
#include "solver/operators/laplacian.hpp"
#include "solver/operators/support.hpp"
#include "solver/scene/forecast.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/domains.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

SceneSpec copper_bar() {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"hencky", 8930, 117e9, 0.35, LinearHardening{0.4e9, 0.1e9}};
  scene.jst4 = Kappa4::constant(1.0 / 4096);
  scene.initial.push_back({"all", Formulas{Expression("0"), Expression("0"), Expression("-227")}});
  scene.walls.push_back({});
  scene.frames = scene.history_rows = 1;
  scene.end_time = 1; // until the step is known
  return scene;
}

SceneSpec rubber_bar() {
  SceneSpec scene = copper_bar();
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.walls.clear();
  return scene;
}

/// Neighbours, gradient and Laplacian of a lattice of range(0)^3 particles, per particle.
void operator_build(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  set_threads(static_cast<int>(state.range(1)));
  const auto cloud = test::box_lattice(n, n, n, Vec3(1, 1, 1));
  for (auto _ : state) {
    const Neighbours graph = uniform_support(cloud.X, 2.2 * cloud.spacing);
    benchmark::DoNotOptimize(build_gradient<3>(cloud.X, cloud.V, graph).omega.data());
    benchmark::DoNotOptimize(build_laplacian<3>(cloud.X, cloud.V, graph).l.data());
  }
  state.counters["ns/particle"] =
      benchmark::Counter(static_cast<double>(cloud.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// A lattice of about `count` particles, or a two-pass cloud of the same cube (20 sweeps on its seeds).
ParticleCloud cube(std::int64_t count, bool two_pass) {
  if (!two_pass) {
    const auto n = static_cast<int>(std::lround(std::cbrt(static_cast<double>(count))));
    return test::box_lattice(n, n, n, Vec3(1, 1, 1));
  }
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = count;
  request.relax_seeds = 20;
  return preprocess::prepare(test::box_domain(), request, Progress::silent()).cloud;
}

/// What the consistent scheme adds to the setting up of a rubber cube of about range(0) particles, on a
/// lattice (support 1.6) or, with range(1), on a two-pass cloud (30 neighbours), and how many of its steps
/// take as long.
void correction(benchmark::State& state) {
  set_threads(1);
  const bool two_pass = state.range(1) > 0;
  const ParticleCloud cloud = cube(state.range(0), two_pass);
  const Neighbours graph = two_pass ? adaptive_support<3>(cloud.X, cloud.V, 30, cloud.hidden)
                                    : uniform_support(cloud.X, 1.6 * cloud.spacing);
  const Gradient<3> plain = build_gradient<3>(cloud.X, cloud.V, graph);
  SceneSpec scene = rubber_bar();
  scene.scheme = "consistent";
  scene.formulation = "pF";
  scene.material.law = "neo_hookean";
  scene.jst4.reset();
  scene.initial = {{"all", Formulas{Expression("X*Y"), Expression("Y*Z"), Expression("Z*X")}, std::nullopt}};
  scene.end_time = 20 * forecast(scene, cloud).dt;
  double seconds = 0, of_steps = 0;
  std::int64_t steps = 0;
  for (auto _ : state) {
    Gradient<3> gradient = plain;
    const auto start = std::chrono::steady_clock::now();
    state.counters["iterations"] =
        static_cast<double>(balance_constant_stress<3>(gradient, cloud.X, cloud.A, graph));
    const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    state.SetIterationTime(taken);
    seconds += taken;
    const Summary summary = run(scene, cloud, {}, Progress::silent());
    of_steps += summary.wall_seconds;
    steps += summary.steps;
  }
  const double corrections = static_cast<double>(state.iterations());
  state.counters["ns/particle"] = 1e9 * seconds / (corrections * static_cast<double>(cloud.size()));
  state.counters["steps"] = seconds / corrections * static_cast<double>(steps) / of_steps;
  state.counters["neighbours"] = graph.mean();
}

/// Runs the scene by run()'s own clock.
void time_steps(benchmark::State& state, const SceneSpec& scene, const ParticleCloud& cloud) {
  double ns = 0, neighbours = 0;
  for (auto _ : state) {
    const Summary summary = run(scene, cloud, {}, Progress::silent());
    state.SetIterationTime(summary.wall_seconds);
    ns += 1e3 * summary.us_per_particle_step;
    neighbours = summary.neighbours_mean;
  }
  state.counters["ns/particle/step"] = ns / static_cast<double>(state.iterations());
  state.counters["neighbours"] = neighbours;
}

/// Steps of a neo-Hookean cube of range(0)^3 particles by formulation, scheme and method, at a support of
/// range(1) / 100 spacings (193: some 25 neighbours of 19^3 particles), on range(2) threads.
void elastic_step(benchmark::State& state, const std::string& formulation, const std::string& scheme,
                  const std::string& integrator) {
  const auto n = static_cast<int>(state.range(0));
  set_threads(static_cast<int>(state.range(2)));
  const auto cloud = test::box_lattice(n, n, n, Vec3(1, 1, 1));
  SceneSpec scene = rubber_bar();
  scene.formulation = formulation;
  scene.scheme = scheme;
  scene.integrator = integrator;
  scene.material.law = "neo_hookean";
  scene.jst4.reset();
  scene.support = static_cast<double>(state.range(1)) / 100;
  scene.initial = {{"all", Formulas{Expression("X*Y"), Expression("Y*Z"), Expression("Z*X")}, std::nullopt}};
  const double steps = std::clamp(1e6 / static_cast<double>(cloud.size()), 6.0, 200.0);
  scene.end_time = steps * forecast(scene, cloud).dt;
  time_steps(state, scene, cloud);
}

/// Whole steps (two stages) of a cylinder of `layers` layers of 81 particles.
void step(benchmark::State& state, const SceneSpec& base) {
  set_threads(static_cast<int>(state.range(1)));
  const auto cloud = test::cylinder_lattice(5, static_cast<int>(state.range(0)), 0.64e-3);
  SceneSpec scene = base;
  scene.end_time = 100 * forecast(scene, cloud).dt;
  time_steps(state, scene, cloud);
}

/// One wall's look at a plane body of range(0) particles across, of which one side's are in touch.
void contact(benchmark::State& state, const std::shared_ptr<const RigidShape>& shape) {
  set_threads(1);
  const auto across = static_cast<int>(state.range(0));
  const auto cloud = test::box_lattice(across, 7 * across, 1, Vec3(0.008, 0.056, 0));
  std::vector<Vec<2>> x, p(cloud.X.size(), Vec<2>(-10, -2800)), impulse(cloud.X.size(), Vec<2>::Zero());
  for (const Vec3& X : cloud.X)
    x.push_back(X.head<2>());
  const std::vector<Vec<2>> p_n = p;
  Wall<2> wall("wall", shape, {}, Vec<2>::Zero(), x.size());
  for (auto _ : state) {
    p = p_n;
    benchmark::DoNotOptimize(wall.limit(x, p, 2800, 0, 1e-8, 1, impulse));
  }
  state.counters["ns/particle"] =
      benchmark::Counter(static_cast<double>(cloud.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
void contact_with_plane(benchmark::State& state) {
  contact(state, std::make_shared<Plane>(Vec3::Zero(), Vec3::UnitX()));
}
void contact_with_channel(benchmark::State& state) {
  contact(state,
          channel({{0.004, 0.056}, {0.004, -0.004}, {0.028, -0.004}, {0.028, -0.048}}, 0.008, 0.0015, 0.001)
              .right);
}

void plastic_step(benchmark::State& state) {
  step(state, copper_bar());
}
void hencky_step(benchmark::State& state) {
  step(state, rubber_bar());
}

} // namespace

BENCHMARK(operator_build)->ArgsProduct({{20, 46}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(contact_with_plane)->Arg(12)->Arg(120);
BENCHMARK(contact_with_channel)->Arg(12)->Arg(120);
BENCHMARK(plastic_step)->ArgsProduct({{51, 501}, {1, 2}})->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK(hencky_step)->ArgsProduct({{51, 501}, {1, 2}})->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK(correction)
    ->ArgsProduct({{10000, 30000, 100000}, {0, 1}})
    ->Iterations(2)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
#define ELASTIC_STEP(name, formulation, scheme, integrator)                                                  \
  BENCHMARK_CAPTURE(elastic_step, name, formulation, scheme, integrator)                                     \
      ->Args({19, 193, 1})                                                                                   \
      ->Unit(benchmark::kMillisecond)                                                                        \
      ->UseManualTime()
ELASTIC_STEP(pF_thesis_heun, "pF", "thesis", "heun");
ELASTIC_STEP(pF_consistent_heun, "pF", "consistent", "heun");
ELASTIC_STEP(pFJ_consistent_heun, "pFJ", "consistent", "heun");
ELASTIC_STEP(pFHJ_consistent_heun, "pFHJ", "consistent", "heun");
ELASTIC_STEP(pF_consistent_verlet, "pF", "consistent", "verlet");
ELASTIC_STEP(pFJ_consistent_verlet, "pFJ", "consistent", "verlet");
ELASTIC_STEP(pFHJ_consistent_verlet, "pFHJ", "consistent", "verlet");
