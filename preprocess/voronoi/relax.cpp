#include "preprocess/voronoi/relax.hpp"

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "preprocess/voronoi/cell_centroids.hpp"
#include "preprocess/voronoi/curve_chains.hpp"
#include "preprocess/voronoi/moves.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace tessera::preprocess {
namespace {

/// How far a point goes, in ways to the centroid. Just below 2, where sweeps would no longer converge, clouds
/// of thousands of points become even in the fewest sweeps.
constexpr double stride = 1.9;

/// Calls next_of(voronoi, i) for every point, `sweeps` times, and moves all points at once.
template <class Next>
void sweep(const TetBody& body, std::vector<Vec3>& points, int sweeps, const char* label, Progress& progress,
           Next&& next_of) {
  const auto n = static_cast<std::int64_t>(points.size());
  progress.begin(label, sweeps);
  double moved = 0;
  for (int s = 0; s < sweeps; ++s) {
    stop_if_interrupted(label);
    const DelaunayGraph graph = delaunay_graph(points);
    const RestrictedVoronoi voronoi(body, points, graph);
    std::vector<Vec3> next(points.size());
    for_each_uneven(n, [&](std::int64_t i) {
      next[i] = next_of(voronoi, i);
      if (body.domain->dimension == 2)
        next[i].z() = 0; // rounding would grow
    });
    moved = std::sqrt(sum(n, 0.0, [&](std::int64_t i) { return (next[i] - points[i]).squaredNorm(); }) /
                      static_cast<double>(n));
    points = std::move(next);
    progress.advance(s + 1, fmt::format("moved by {:.2g} m", moved * body.scaling.length));
  }
  progress.finish(fmt::format("{} sweep{}, moved by {:.2g} m in the last", sweeps, sweeps == 1 ? "" : "s",
                              moved * body.scaling.length));
}

} // namespace

std::vector<Vec3> relaxed_seeds(const TetBody& body, const CadTopology& cad, std::vector<Vec3> seeds,
                                const SizeField& size, int sweeps, Progress& progress) {
  const Moves moves(body, cad);
  sweep(body, seeds, sweeps, "relaxing seeds", progress,
        [&](const RestrictedVoronoi& voronoi, std::int64_t i) {
          const Vec3& x = voronoi.seeds()[i];
          const Vec3 centroid = CellCentroids(voronoi, size).of_cell(i);
          return moves.inside(x, x + stride * (centroid - x));
        });
  return seeds;
}

PlacedPoints relaxed(const TetBody& body, const CadTopology& cad, PlacedPoints particles,
                     const SizeField& size, int sweeps, Progress& progress) {
  if (sweeps <= 0)
    return particles;
  CurveChains(body, cad, size).spread(particles);
  const Moves moves(body, cad);
  const int dimension = body.domain->dimension;
  sweep(body, particles.X, sweeps, "relaxing particles", progress,
        [&](const RestrictedVoronoi& voronoi, std::int64_t i) -> Vec3 {
          const Vec3& x = voronoi.seeds()[i];
          const CadPlace& place = particles.place[i];
          const CellCentroids centroids(voronoi, size);
          if (place.dimension == dimension)
            return moves.inside(x, x + stride * (centroids.of_cell(i) - x));
          if (place.dimension < 2)
            return x;
          const auto centroid = centroids.of_surface(i, place.entity);
          return centroid ? moves.on_surface(x, x + stride * (*centroid - x), place.entity) : x;
        });
  return particles;
}

} // namespace tessera::preprocess
