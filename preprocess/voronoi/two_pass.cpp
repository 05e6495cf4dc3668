#include "preprocess/voronoi/two_pass.hpp"

#include "core/interrupt.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "preprocess/seeding/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace tessera::preprocess {
namespace {

TwoPass one_try(const TetBody& body, const CadTopology& cad, std::int64_t seeds, double merge,
                std::uint64_t seed) {
  RandomPoints random(*body.domain, seed);
  std::vector<Vec3> points;
  points.reserve(seeds);
  for (std::int64_t i = 0; i < seeds; ++i)
    points.push_back(body.scaling.in(random.next()));
  points = permuted(points, hilbert_order(points));
  const DelaunayGraph graph = delaunay_graph(points);
  stop_if_interrupted("first Voronoi pass");
  const PlacedPoints vertices = cell_vertices(RestrictedVoronoi(body, points, graph));
  stop_if_interrupted("first Voronoi pass");
  const double h = std::cbrt(body.domain->volume / static_cast<double>(vertices.size()));
  return {merged(vertices, cad, merge * h / body.scaling.length), seeds, h};
}

} // namespace

TwoPass two_pass_points(const TetBody& body, const CadTopology& cad, const TwoPassRequest& request,
                        Progress& progress) {
  const auto& [count, merge, seed, size, relax_seeds] = request;
  constexpr int most_tries = 16;
  const auto wanted = static_cast<double>(count);
  progress.begin("first Voronoi pass", most_tries);
  TwoPass best;
  double best_error = std::numeric_limits<double>::infinity();
  std::set<std::int64_t> tried;
  // About 6.5 vertices a seed, half of them left at the usual radius of 0.5.
  auto seeds = std::max<std::int64_t>(1, std::llround(wanted / (6.5 * std::max(0.2, 1 - merge))));
  for (int t = 0; t < most_tries && tried.insert(seeds).second; ++t) {
    TwoPass next = one_try(body, cad, seeds, merge, seed);
    const auto got = static_cast<double>(next.points.size());
    const double error = std::abs(got - wanted) / wanted;
    progress.advance(t + 1, fmt::format("{} seeds, {} particles", seeds, next.points.size()));
    if (error < best_error) {
      best = std::move(next);
      best_error = error;
    }
    if (best_error <= 0.02)
      break;
    auto corrected = std::max<std::int64_t>(1, std::llround(static_cast<double>(seeds) * wanted / got));
    // Small clouds: neighbouring numbers of seeds differ by several particles; look at those not tried yet.
    for (std::int64_t step = 1; tried.count(corrected) && step < most_tries; ++step)
      corrected = std::max<std::int64_t>(1, corrected + (step % 2 ? step : -step));
    seeds = corrected;
  }
  progress.finish(fmt::format("{} seeds, {} particles", best.seeds, best.points.size()));
  return best;
}

} // namespace tessera::preprocess
