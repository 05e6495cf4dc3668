#include "preprocess/cloud/prepare.hpp"

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "preprocess/cloud/assess.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "preprocess/cloud/sets.hpp"
#include "preprocess/seeding/lattice.hpp"
#include "preprocess/voronoi/two_pass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tessera::preprocess {
namespace {

constexpr double most_particles = 50e6;
constexpr double bytes_per_particle = 1500; ///< of the tessellation: graph, triangulation, cells

/// Seconds by stage, for quality.json.
class Stopwatch {
 public:
  explicit Stopwatch(Quality& quality) : quality_(quality) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    quality_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  Quality& quality_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The particles before their cells are known.
struct Arranged {
  std::vector<Vec3> X;      ///< m
  std::vector<Vec3> scaled; ///< in the body's coordinates
  std::vector<Vec3>
      graph_from; ///< what the neighbours are found from: a lattice's exact integers, else `scaled`
  std::vector<CadPlace> place;
  double h = 0; ///< unit of the smallest distance: lattice spacing, or what merging used, m

  void keep(const std::vector<std::int32_t>& order) {
    X = permuted(X, order);
    scaled = permuted(scaled, order);
    graph_from = permuted(graph_from, order);
    place = permuted(place, order);
  }
};

void check_request(const Domain& domain, const ParticleRequest& request) {
  const bool by_spacing = request.spacing > 0, by_count = request.count > 0;
  require(std::isfinite(request.spacing) && request.spacing >= 0 && request.count >= 0, // also refuses NaN
          "spacing and count cannot be negative", "particles", "give one of them as a positive number");
  require(by_spacing != by_count, "exactly one of spacing and count is needed", "particles",
          "give the particle spacing in metres or the number of particles");
  require(request.merge >= 0 && request.merge <= 0.9,
          fmt::format("merge = {:.3g} is out of range", request.merge), "particles",
          "choose a fraction of the spacing from 0 to 0.9");
  const double particles =
      by_count ? static_cast<double>(request.count) : domain.volume / std::pow(request.spacing, 3);
  require(particles <= most_particles,
          fmt::format("about {:.3g} particles would need {:.3g} GB to prepare", particles,
                      particles * bytes_per_particle / 1e9),
          "particles",
          fmt::format("choose a spacing above {:.3g} m", std::cbrt(domain.volume / most_particles)));
  for (std::size_t s = 0; s < request.sets.size(); ++s) {
    const auto same = [&](const auto& other) { return other.name == request.sets[s].name; };
    require(!request.sets[s].name.empty(), "a set has no name", "sets", "name it");
    require(std::none_of(request.sets.begin(), request.sets.begin() + s, same) &&
                std::none_of(domain.groups.begin(), domain.groups.end(), same),
            "two sets have one name", fmt::format("set \"{}\"", request.sets[s].name), "rename one of them");
  }
}

Arranged arrange_lattice(const Domain& domain, const CadTopology& cad, const Scaling& scaling,
                         double spacing) {
  const Lattice lattice = lattice_points(domain, cad, spacing);
  Arranged result;
  const std::size_t n = lattice.index.size();
  for (std::size_t i = 0; i < n; ++i) {
    result.X.push_back(lattice.position(i));
    result.scaled.push_back(scaling.in(result.X.back()));
    result.graph_from.emplace_back(lattice.index[i][0], lattice.index[i][1], lattice.index[i][2]);
  }
  result.place = lattice.place;
  result.h = spacing;
  return result;
}

/// Puts points of the CAD model back on it to the last bit: corners, and coordinates that all vertices of
/// their surface share.
class Snap {
 public:
  Snap(const Domain& domain, const CadTopology& cad) : domain_(domain), cad_(cad) {
    const double nan = std::nan("");
    constant_.assign(domain.surfaces.size(), Vec3::Constant(nan));
    std::vector<bool> seen(domain.surfaces.size(), false);
    for (const auto& facet : domain.facets)
      for (const std::int32_t v : facet.vertices) {
        Vec3& constant = constant_[facet.surface];
        if (!seen[facet.surface])
          constant = domain.vertices[v];
        seen[facet.surface] = true;
        for (int a = 0; a < 3; ++a)
          if (constant[a] != domain.vertices[v][a])
            constant[a] = nan;
      }
  }
  Vec3 operator()(Vec3 X, const CadPlace& place) const {
    if (place.dimension == 0)
      return domain_.vertices[place.entity];
    for (const std::int32_t s : cad_.surfaces_of(place))
      for (int a = 0; a < 3; ++a)
        if (!std::isnan(constant_[s][a]))
          X[a] = constant_[s][a];
    return X;
  }

 private:
  const Domain& domain_;
  const CadTopology& cad_;
  std::vector<Vec3> constant_; ///< by surface: the coordinates all its vertices share, NaN where they differ
};

Arranged arrange_two_pass(const TetBody& body, const CadTopology& cad, std::int64_t count,
                          const ParticleRequest& request, Progress& progress) {
  const TwoPass cloud = two_pass_points(body, cad, count, request.merge, request.seed, progress);
  const Snap snap(*body.domain, cad);
  Arranged result;
  for (std::int64_t i = 0; i < cloud.points.size(); ++i) {
    result.X.push_back(snap(body.scaling.out(cloud.points.X[i]), cloud.points.place[i]));
    result.scaled.push_back(body.scaling.in(result.X.back()));
  }
  result.graph_from = result.scaled;
  result.place = cloud.points.place;
  result.h = cloud.h;
  return result;
}

void fill_geometry(const TetBody& body, const Arranged& arranged, const CellMeasures& measures,
                   const ParticleRequest& request, ParticleCloud& cloud) {
  const double L = body.scaling.length;
  const std::int64_t n = static_cast<std::int64_t>(arranged.X.size());
  cloud.domain_volume = body.domain->volume;
  cloud.seed = request.arrangement == Arrangement::lattice ? 0 : request.seed;
  cloud.arrangement = request.arrangement == Arrangement::lattice ? "lattice" : "voronoi";
  cloud.subvolumes = request.subvolumes == Subvolumes::voronoi ? "voronoi" : "uniform";
  cloud.spacing = request.arrangement == Arrangement::lattice
                      ? arranged.h
                      : std::cbrt(cloud.domain_volume / static_cast<double>(n));
  cloud.X = arranged.X;
  cloud.V.resize(n);
  cloud.A.assign(n, Vec3::Zero());
  cloud.centroid.resize(n);
  cloud.cad_dimension.resize(n);
  for_each(n, [&](std::int64_t i) {
    cloud.V[i] = measures.volume[i] * L * L * L;
    cloud.centroid[i] = arranged.X[i] + measures.moment[i] / measures.volume[i] * L;
    cloud.cad_dimension[i] = arranged.place[i].dimension;
    for (const SurfaceShare& share : measures.shares[i])
      cloud.A[i] += share.area * L * L;
  });
  // The boundary is closed; what rounding leaves of the sum of A is spread over those that own area.
  const Vec3 open = sum(n, Vec3(Vec3::Zero()), [&](std::int64_t i) { return cloud.A[i]; });
  const double total = sum(n, 0.0, [&](std::int64_t i) { return cloud.A[i].norm(); });
  if (total > 0)
    for_each(n, [&](std::int64_t i) { cloud.A[i] -= open * (cloud.A[i].norm() / total); });
}

void check_volume(const Quality& quality) {
  if (quality.volume_error < 1e-9)
    return;
  throw InputError(fmt::format("the cells' volumes sum to {:.12g} m^3, the body has {:.12g} m^3",
                               quality.volume_sum, quality.domain_volume),
                   "Voronoi tessellation",
                   "check the mesh for overlapping or inverted parts and remesh the body");
}

} // namespace

Prepared prepare(const Domain& domain, const ParticleRequest& request, Progress& progress) {
  check_request(domain, request);
  Prepared result;
  Stopwatch watch(result.quality);
  const bool is_lattice = request.arrangement == Arrangement::lattice;
  const CadTopology cad(domain);
  double spacing =
      request.spacing > 0 ? request.spacing : std::cbrt(domain.volume / static_cast<double>(request.count));
  if (is_lattice && request.count > 0)
    spacing = lattice_spacing_for(domain, cad, request.count);
  const TetBody body(domain, scaling_for(domain, spacing));
  watch.lap("body");

  const std::int64_t count =
      request.count > 0 ? request.count : std::llround(domain.volume / std::pow(spacing, 3));
  Arranged particles;
  if (is_lattice || count > 0)
    particles = is_lattice ? arrange_lattice(domain, cad, body.scaling, spacing)
                           : arrange_two_pass(body, cad, count, request, progress);
  const Vec3 size = domain.upper - domain.lower;
  require(particles.X.size() >= 4, "fewer than four particles fit into the body", "particles",
          fmt::format("choose a spacing well below the body's size of {:.3g} x {:.3g} x {:.3g} m", size[0],
                      size[1], size[2]));
  particles.keep(hilbert_order(particles.scaled));
  watch.lap("points");
  stop_if_interrupted("preparing particles");

  progress.begin("Voronoi cells", 2);
  CellMeasures measures;
  DelaunayGraph graph;
  for (bool again = true; again;) {
    graph = delaunay_graph(particles.graph_from);
    watch.lap("delaunay");
    progress.advance(1);
    stop_if_interrupted("Voronoi cells");
    const RestrictedVoronoi voronoi(body, particles.scaled, graph);
    measures = measure_cells(voronoi);
    // A point beyond the boundary whose cell misses the body owns nothing: it is no particle.
    const double mean =
        std::pow(1 / body.scaling.length, 3) * domain.volume / static_cast<double>(voronoi.size());
    std::vector<std::int32_t> owning;
    for (std::int32_t i = 0; i < voronoi.size(); ++i)
      if (measures.volume[i] > 1e-9 * mean)
        owning.push_back(i);
    again = owning.size() < particles.X.size();
    if (again)
      particles.keep(owning);
    else if (request.keep_cells)
      result.cells = collect_cells(voronoi, measures);
    watch.lap("cells");
    stop_if_interrupted("Voronoi cells");
  }
  progress.finish(fmt::format("{} particles", particles.X.size()));

  ParticleCloud& cloud = result.cloud;
  fill_geometry(body, particles, measures, request, cloud);
  result.quality.closure_error = measures.closure_error;
  result.quality.disconnected_cells = measures.disconnected;
  result.quality.corners = static_cast<std::int64_t>(domain.corners.size());
  assess(domain, cloud, graph, particles.h, result.quality);
  check_volume(result.quality);
  if (request.subvolumes == Subvolumes::uniform) {
    // The cells proved exact above; the particles share the volume alike all the same.
    cloud.V.assign(cloud.X.size(), domain.volume / static_cast<double>(cloud.size()));
    assess(domain, cloud, graph, particles.h, result.quality);
  }

  for (auto& shares : measures.shares)
    for (auto& share : shares)
      share.area *= body.scaling.length * body.scaling.length;
  const SetSource source{domain, cad, cloud, particles.place, measures.shares, is_lattice};
  cloud.sets = group_sets(source);
  for (const SetSelector& selector : request.sets)
    cloud.sets.push_back(selected_set(source, selector));
  for (const ParticleSet& set : cloud.sets)
    result.quality.sets.emplace_back(set.name, static_cast<std::int64_t>(set.particles.size()));
  watch.lap("sets");
  cloud.validate("prepared cloud");
  return result;
}

} // namespace tessera::preprocess
