#include "preprocess/voronoi/two_pass.hpp"

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "preprocess/seeding/random.hpp"
#include "preprocess/voronoi/relax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace tessera::preprocess {
namespace {

/// Draws seeds and takes the vertices of their cells as particles, for any number of seeds.
class FirstPass {
 public:
  FirstPass(const TetBody& body, const CadTopology& cad, const TwoPassRequest& request, Progress& progress)
      : body_(body), cad_(cad), request_(request), progress_(progress),
        volume_(graded_volume(*body.domain, request.size)) {}

  TwoPass operator()(std::int64_t count) const {
    const int dimension = body_.domain->dimension;
    RandomPoints random(*body_.domain, request_.seed, request_.size);
    std::vector<Vec3> seeds;
    seeds.reserve(count);
    for (std::int64_t i = 0; i < count; ++i)
      seeds.push_back(body_.scaling.in(random.next()));
    seeds = permuted(seeds, hilbert_order(seeds));
    if (request_.relax_seeds > 0)
      seeds = relaxed_seeds(body_, cad_, std::move(seeds), request_.size, request_.relax_seeds, progress_);
    progress_.begin("first Voronoi pass", 3);
    const DelaunayGraph graph = delaunay_graph(seeds);
    progress_.advance(1);
    stop_if_interrupted("first Voronoi pass");
    const PlacedPoints vertices = cell_vertices(RestrictedVoronoi(body_, seeds, graph));
    progress_.advance(2);
    stop_if_interrupted("first Voronoi pass");
    const double h = std::pow(volume_ / static_cast<double>(vertices.size()), 1. / dimension);
    const double radius = request_.merge * h / body_.scaling.length;
    std::vector<double> radii(vertices.X.size(), radius);
    if (request_.size)
      for_each(vertices.size(),
               [&](std::int64_t i) { radii[i] *= request_.size(body_.scaling.out(vertices.X[i])); });
    TwoPass result{merged(vertices, cad_, radii, dimension), count, h};
    progress_.finish(fmt::format("{} seeds, {} particles", count, result.points.size()));
    return result;
  }

  /// Seeds that give about this many particles.
  std::int64_t seeds_for(double particles) const {
    // A seed has about 6.5 vertices (2 in the plane); merging at the usual radius of 0.5 leaves half of them
    // (two thirds).
    const bool plane = body_.domain->dimension == 2;
    const double kept = plane ? 2 * (1 - 0.7 * request_.merge) : 6.5 * std::max(0.2, 1 - request_.merge);
    return std::max<std::int64_t>(1, std::llround(particles / kept));
  }

 private:
  const TetBody& body_;
  const CadTopology& cad_;
  const TwoPassRequest& request_;
  Progress& progress_;
  double volume_;
};

} // namespace

TwoPass two_pass_points(const TetBody& body, const CadTopology& cad, const TwoPassRequest& request,
                        Progress& progress) {
  constexpr int most_tries = 16;
  const auto wanted = static_cast<double>(request.count);
  TwoPass best;
  double best_error = std::numeric_limits<double>::infinity();
  std::set<std::int64_t> tried;
  const FirstPass first_pass(body, cad, request, progress);
  auto seeds = first_pass.seeds_for(wanted);
  for (int t = 0; t < most_tries && tried.insert(seeds).second; ++t) {
    TwoPass next = first_pass(seeds);
    const auto got = static_cast<double>(next.points.size());
    const double error = std::abs(got - wanted) / wanted;
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
  return best;
}

} // namespace tessera::preprocess
