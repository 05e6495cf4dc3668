/// What this machine can do at best: the yardsticks beside which the solver's own figures stand.
#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "tests/support/clouds.hpp"

#include <benchmark/benchmark.h>

#include <vector>

using namespace tessera;

namespace {

/// a = b + s c over three arrays of range(0) MiB, on range(1) threads: the bandwidth of the memory, the bytes
/// counted that the code names (24 an entry).
void triad(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  const std::int64_t n = state.range(0) * 1024 * 1024 / static_cast<std::int64_t>(sizeof(double));
  std::vector<double> a(static_cast<std::size_t>(n)), b(a), c(a);
  for_each(n, [&](std::int64_t i) {
    b[i] = 1;
    c[i] = static_cast<double>(i);
  });
  for (auto _ : state) {
    for_each(n, [&](std::int64_t i) { a[i] = b[i] + 3 * c[i]; });
    benchmark::ClobberMemory();
  }
  state.counters["GB/s"] =
      benchmark::Counter(static_cast<double>(3 * sizeof(double)) * static_cast<double>(n) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate);
}

void count_gather(benchmark::State& state, const Neighbours& graph) {
  state.counters["ns/particle"] =
      benchmark::Counter(static_cast<double>(graph.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["neighbours"] = graph.mean();
}

/// Sums of a weighted 3 x 3 tensor over some 56 neighbours (range(0)^3 lattice particles, 2.3 spacings) and
/// nothing else, on range(1) threads: what every code of the kind has to do at least, so that figures of
/// other machines can be put beside those of this one.
void gather(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  const auto n = static_cast<int>(state.range(0));
  const auto cloud = test::box_lattice(n, n, n, Vec3(1, 1, 1));
  const Neighbours graph = find_neighbours(cloud.X, std::vector<double>(cloud.X.size(), 2.3 * cloud.spacing));
  const std::vector<double> w(graph.column.size(), 0.5);
  const std::vector<Mat3> P(cloud.X.size(), Mat3::Identity());
  std::vector<Mat3> sums(P);
  for (auto _ : state) {
    for_each(graph.size(), [&](std::int64_t a) {
      Mat3 sum = Mat3::Zero();
      for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e)
        sum += w[e] * P[graph.column[e]];
      sums[a] = sum;
    });
    benchmark::ClobberMemory();
  }
  count_gather(state, graph);
}

/// The same sums on one thread, an array and a sweep for each of the nine components: no vector instruction
/// helps here, and each addition waits for the last. A figure whose code is not known may be one like this.
void gather_by_component(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const auto cloud = test::box_lattice(n, n, n, Vec3(1, 1, 1));
  const Neighbours graph = find_neighbours(cloud.X, std::vector<double>(cloud.X.size(), 2.3 * cloud.spacing));
  const std::vector<double> w(graph.column.size(), 0.5);
  const std::vector<std::vector<double>> P(9, std::vector<double>(cloud.X.size(), 1.0));
  auto sums = P;
  for (auto _ : state) {
    for (std::size_t component = 0; component < P.size(); ++component)
      for (std::int64_t a = 0; a < graph.size(); ++a) {
        double sum = 0;
        for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e)
          sum += w[e] * P[component][graph.column[e]];
        sums[component][a] = sum;
      }
    benchmark::ClobberMemory();
  }
  count_gather(state, graph);
}

} // namespace

BENCHMARK(triad)->ArgsProduct({{64}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gather)->ArgsProduct({{19, 46}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gather_by_component)->Arg(19)->Arg(46)->Unit(benchmark::kMillisecond);
