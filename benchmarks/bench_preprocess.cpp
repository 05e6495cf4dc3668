// Seeds a second of the restricted Voronoi cells and points a second of the lattice scan.
#include "core/parallel.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "preprocess/seeding/lattice.hpp"
#include "preprocess/seeding/random.hpp"
#include "preprocess/voronoi/cell_measures.hpp"
#include "preprocess/voronoi/vertices.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace tessera;
using namespace tessera::preprocess;

/// The L-shaped block, a block with a bore, the L-shaped block in more than 50,000 tetrahedra, an L in the
/// plane.
enum Body { ell, holed, fine_ell, plane_ell };

Domain domain_of(int body) {
  switch (body) {
  case ell:
    return test::l_domain(3);
  case holed:
    return test::holed_domain(3);
  case fine_ell:
    return test::l_domain(15);
  default:
    return test::l_slab(8);
  }
}

struct Seeded {
  Domain domain;
  TetBody body;
  std::vector<Vec3> seeds;

  Seeded(int shape, std::int64_t count)
      : domain(domain_of(shape)),
        body(domain, scaling_for(domain, std::pow(domain.volume / static_cast<double>(count),
                                                  1.0 / domain.dimension))) {
    RandomPoints random(domain, 1);
    for (std::int64_t i = 0; i < count; ++i)
      seeds.push_back(body.scaling.in(random.next()));
    seeds = permuted(seeds, hilbert_order(seeds));
  }
};

/// Neighbours, clipping and measures; arguments: body, seeds, backend (0 clipper, 1 Voro++), threads.
void voronoi_cells(benchmark::State& state) {
  const Seeded s(static_cast<int>(state.range(0)), state.range(1));
  const bool voro = state.range(2) == 1;
  set_threads(static_cast<int>(state.range(3)));
  for (auto _ : state) {
    const DelaunayGraph graph = voro ? voro_neighbours(s.body, s.seeds) : delaunay_graph(s.seeds);
    benchmark::DoNotOptimize(
        measure_cells(RestrictedVoronoi(s.body, s.seeds, graph, voro ? Backend::voro : Backend::clipper)));
  }
  state.SetItemsProcessed(state.iterations() * state.range(1));
  state.counters["tets"] = static_cast<double>(s.domain.tets.size());
}
BENCHMARK(voronoi_cells)
    ->ArgNames({"body", "seeds", "voro", "threads"})
    ->ArgsProduct({{ell, holed, fine_ell}, {1000, 10000, 100000}, {0, 1}, {1, 2}})
    ->ArgsProduct({{plane_ell}, {100000}, {0, 1}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(voronoi_cells)
    ->Name("million_cells")
    ->ArgNames({"body", "seeds", "voro", "threads"})
    ->ArgsProduct({{ell}, {1000000}, {0}, {1, 2}})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void delaunay_neighbours(benchmark::State& state) {
  const Seeded s(static_cast<int>(state.range(0)), state.range(1));
  set_threads(static_cast<int>(state.range(2)));
  for (auto _ : state)
    benchmark::DoNotOptimize(delaunay_graph(s.seeds));
  state.SetItemsProcessed(state.iterations() * state.range(1));
}
BENCHMARK(delaunay_neighbours)
    ->ArgNames({"body", "seeds", "threads"})
    ->ArgsProduct({{ell, plane_ell}, {100000}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Vertices of the first pass, neighbours given.
void first_pass(benchmark::State& state) {
  const Seeded s(ell, state.range(0));
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
    points +=
        static_cast<std::int64_t>(lattice_points(domain, cad, {LatticeKind::cubic, spacing}).index.size());
  state.SetItemsProcessed(points);
}
BENCHMARK(lattice_scan)->ArgName("per_metre")->Arg(32)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

/// Neighbours of lattice points: everywhere degenerate.
void lattice_cells(benchmark::State& state) {
  const Domain domain = test::l_domain(3);
  const CadTopology cad(domain);
  const Lattice lattice =
      lattice_points(domain, cad, {LatticeKind::cubic, 1.0 / static_cast<double>(state.range(0))});
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
