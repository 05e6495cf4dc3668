// Seeds a second of the restricted Voronoi cells and points a second of the lattice scan, on the L-shaped
// block.
#include "core/parallel.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "preprocess/seeding/lattice.hpp"
#include "preprocess/seeding/random.hpp"
#include "preprocess/voronoi/cell_measures.hpp"
#include "preprocess/voronoi/vertices.hpp"
#include "tests/support/domains.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace tessera;
using namespace tessera::preprocess;

struct Seeded {
  Domain domain;
  TetBody body;
  std::vector<Vec3> seeds;

  Seeded(int cells, std::int64_t count)
      : domain(test::l_domain(cells)),
        body(domain, scaling_for(domain, std::cbrt(domain.volume / static_cast<double>(count)))) {
    RandomPoints random(domain, 1);
    for (std::int64_t i = 0; i < count; ++i)
      seeds.push_back(body.scaling.in(random.next()));
    seeds = permuted(seeds, hilbert_order(seeds));
  }
};

/// Neighbours, clipping and measures; arguments: seeds, cells of the block's unit, threads.
void voronoi_cells(benchmark::State& state) {
  const Seeded s(static_cast<int>(state.range(1)), state.range(0));
  set_threads(static_cast<int>(state.range(2)));
  for (auto _ : state) {
    const DelaunayGraph graph = delaunay_graph(s.seeds);
    benchmark::DoNotOptimize(measure_cells(RestrictedVoronoi(s.body, s.seeds, graph)));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["tets"] = static_cast<double>(s.domain.tets.size());
}
BENCHMARK(voronoi_cells)
    ->ArgNames({"seeds", "cells", "threads"})
    ->ArgsProduct({{1000, 10000, 100000}, {3, 14}, {1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(voronoi_cells)
    ->ArgNames({"seeds", "cells", "threads"})
    ->ArgsProduct({{100000}, {3}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void delaunay_neighbours(benchmark::State& state) {
  const Seeded s(3, state.range(0));
  set_threads(1);
  for (auto _ : state)
    benchmark::DoNotOptimize(delaunay_graph(s.seeds));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(delaunay_neighbours)->ArgNames({"seeds"})->Arg(100000)->Unit(benchmark::kMillisecond);

/// Vertices of the first pass, neighbours given.
void first_pass(benchmark::State& state) {
  const Seeded s(3, state.range(0));
  set_threads(1);
  const DelaunayGraph graph = delaunay_graph(s.seeds);
  const RestrictedVoronoi voronoi(s.body, s.seeds, graph);
  for (auto _ : state)
    benchmark::DoNotOptimize(cell_vertices(voronoi));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(first_pass)->ArgName("seeds")->Arg(100000)->Unit(benchmark::kMillisecond);

void lattice_scan(benchmark::State& state) {
  const Domain domain = test::l_domain(3);
  const CadTopology cad(domain);
  const double spacing = 1.0 / static_cast<double>(state.range(0));
  std::int64_t points = 0;
  for (auto _ : state)
    points += static_cast<std::int64_t>(lattice_points(domain, cad, spacing).index.size());
  state.SetItemsProcessed(points);
}
BENCHMARK(lattice_scan)->ArgName("per_metre")->Arg(32)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

/// Neighbours of lattice points: everywhere degenerate.
void lattice_cells(benchmark::State& state) {
  const Domain domain = test::l_domain(3);
  const CadTopology cad(domain);
  const Lattice lattice = lattice_points(domain, cad, 1.0 / static_cast<double>(state.range(0)));
  std::vector<Vec3> integers;
  for (const auto& i : lattice.index)
    integers.emplace_back(i[0], i[1], i[2]);
  integers = permuted(integers, hilbert_order(integers));
  set_threads(1);
  for (auto _ : state)
    benchmark::DoNotOptimize(delaunay_graph(integers));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(integers.size()));
}
BENCHMARK(lattice_cells)->ArgName("per_metre")->Arg(32)->Unit(benchmark::kMillisecond);

} // namespace
