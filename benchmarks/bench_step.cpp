/// How near the solver's step comes to what the memory allows, from a thousand to four million particles.
#include "core/lanes.hpp"
#include "core/parallel.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// Bytes and floating-point operations of a particle in a step, each array counted once a pass, as it is read
/// or written, in the order of the code: what a cache of no size but for the neighbours' has to move.
/// Elastic, in space, free, with the residual dissipation and the momentum projection; k neighbours.
struct Work {
  double bytes, operations;
};
Work work_of(const std::string& formulation, const std::string& integrator, double k) {
  constexpr double vector = sizeof(Vec3), tensor = sizeof(Mat3), number = sizeof(double);
  constexpr double anchor = sizeof(Lanes<3, 2>), field = sizeof(Lanes<3>), slope = sizeof(Lanes<3, 3>),
                   pull = sizeof(Lanes<3, 6>);
  const bool J = formulation != "pF", H = formulation == "pFHJ";
  const double edges = 2 * number + 8 * k; // row; column and omega
  const double strain = tensor + J * number + H * tensor;
  const double send = (vector + J * number) + field;
  const double momenta = edges + anchor + field + 2 * tensor + number // gather; B, M^-1, V
                         + slope + 2 * vector + vector + 2 * strain   // slope; x of U and U^n, p; strains
                         + J * 3 * number + H * 2 * tensor;           // pull of the penalty, ledger
  const double stresses = strain + vector                             // check
                          + strain + tensor + pull + 3 * number       // P, [PB|P], wave
                          + 2 * number + field;                       // strength
  const double forces = edges + anchor + pull + slope + 2 * field + number + 2 * vector + J * number;
  const double projection = (2 * vector + number) + 3 * vector;
  const double kick = 4 * vector + 2 * vector + J * 4 * number;
  const double ledger = 4 * vector + number + J * (4 * number + 2 * tensor) + H * 4 * tensor;
  // An edge: differences 8 + 4 and products with omega 8 lanes; 8 + 24 x 2 a sweep of six columns; 3 more.
  const double momenta_operations = k * (12 + 8 + 2 * 24) + 120,
               force_operations = k * (20 + 8 + 2 * 36 + 20);
  const double law = 150;
  const int stages = integrator == "heun" ? 2 : 1;
  return {stages * (send + momenta + stresses + forces + projection) + 2 * kick + ledger,
          stages * (momenta_operations + force_operations + law)};
}

/// Bytes a second of a = b + s c over 64 MiB each, the fastest of some.
double memory_bandwidth(int n_threads) {
  set_threads(n_threads);
  const std::int64_t n = 8 << 20;
  std::vector<double> a(static_cast<std::size_t>(n), 0.0), b(a), c(a);
  double best = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const auto start = std::chrono::steady_clock::now();
    for_each(n, [&](std::int64_t i) { a[i] = b[i] + 3 * c[i]; });
    benchmark::ClobberMemory();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    best = std::max(best, 3 * sizeof(double) * static_cast<double>(n) / taken.count());
  }
  return best;
}

/// A cube of range(0)^3 particles, renumbered as clouds are, at some 25 neighbours; range(1) threads.
void step_of_limit(benchmark::State& state, const std::string& formulation, const std::string& integrator) {
  const auto across = static_cast<int>(state.range(0));
  const auto n_threads = static_cast<int>(state.range(1));
  const double bandwidth = memory_bandwidth(n_threads);
  ParticleCloud cloud = test::box_lattice(across, across, across, Vec3(1, 1, 1));
  const auto order = preprocess::hilbert_order(cloud.X);
  cloud.X = preprocess::permuted(cloud.X, order);
  cloud.V = preprocess::permuted(cloud.V, order);
  cloud.A = preprocess::permuted(cloud.A, order);
  cloud.centroid = preprocess::permuted(cloud.centroid, order);
  cloud.cad_dimension = preprocess::permuted(cloud.cad_dimension, order);
  cloud.sets.clear();
  SceneSpec scene;
  scene.formulation = formulation;
  scene.integrator = integrator;
  scene.material = {"neo_hookean", 1100, 17e6, 0.3, std::nullopt};
  scene.support = 1.9;
  scene.initial = {{"all", Formulas{Expression("X*Y"), Expression("Y*Z"), Expression("Z*X")}, std::nullopt}};
  scene.frames = scene.history_rows = 1;
  scene.end_time = 1;
  const auto steps =
      static_cast<std::int64_t>(std::clamp(2e6 / static_cast<double>(cloud.size()), 100.0, 2000.0));
  Outputs outputs;
  outputs.enough = [steps](double, std::int64_t taken) { return taken >= steps; };
  double ns = 0, neighbours = 0, bytes = 0;
  for (auto _ : state) {
    const Summary summary = run(scene, cloud, outputs, Progress::silent());
    state.SetIterationTime(summary.wall_seconds);
    ns += 1e3 * summary.us_per_particle_step;
    neighbours = summary.neighbours_mean;
    bytes = summary.bytes_per_particle;
  }
  ns /= static_cast<double>(state.iterations());
  const Work work = work_of(formulation, integrator, neighbours);
  state.counters["ns"] = ns;
  state.counters["particles"] = static_cast<double>(cloud.size());
  state.counters["neighbours"] = neighbours;
  state.counters["held_B"] = bytes;
  state.counters["moved_B"] = work.bytes;
  state.counters["GB/s"] = work.bytes / ns;
  state.counters["of_memory"] = work.bytes / ns * 1e9 / bandwidth;
  state.counters["GFlop/s"] = work.operations / ns;
}

} // namespace

#define STEP_OF_LIMIT(name, formulation, integrator, ...)                                                    \
  BENCHMARK_CAPTURE(step_of_limit, name, formulation, integrator)                                            \
      ->ArgsProduct({{__VA_ARGS__}, {1, 2}})                                                                 \
      ->Iterations(1)                                                                                        \
      ->Unit(benchmark::kMillisecond)                                                                        \
      ->UseManualTime()
STEP_OF_LIMIT(pF_verlet, "pF", "verlet", 10, 19, 31, 48, 100, 159);
STEP_OF_LIMIT(pF_heun, "pF", "heun", 19, 48, 100);
STEP_OF_LIMIT(pFJ_verlet, "pFJ", "verlet", 19, 48, 100);
STEP_OF_LIMIT(pFHJ_verlet, "pFHJ", "verlet", 19, 48, 100);
