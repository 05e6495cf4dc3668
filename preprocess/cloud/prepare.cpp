#include "preprocess/cloud/prepare.hpp"

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "preprocess/cloud/arrange.hpp"
#include "preprocess/cloud/assess.hpp"
#include "preprocess/cloud/boundary_areas.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "preprocess/cloud/sets.hpp"
#include "preprocess/cloud/visibility.hpp"
#include "preprocess/geometry/body_mesh.hpp"
#include "preprocess/voronoi/voro.hpp"

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

void check_request(const Domain& domain, const ParticleRequest& request) {
  const bool by_spacing = request.spacing > 0, by_count = request.count > 0;
  require(std::isfinite(request.spacing) && request.spacing >= 0 && request.count >= 0, // also refuses NaN
          "spacing and count cannot be negative", "particles", "give one of them as a positive number");
  require(by_spacing != by_count, "exactly one of spacing and count is needed", "particles",
          "give the particle spacing in metres or the number of particles");
  require(request.merge >= 0 && request.merge <= 0.9,
          fmt::format("merge = {:.3g} is out of range", request.merge), "particles",
          "choose a fraction of the spacing from 0 to 0.9");
  const double particles = by_count ? static_cast<double>(request.count)
                                    : domain.volume / std::pow(request.spacing, domain.dimension);
  require(particles <= most_particles,
          fmt::format("about {:.3g} particles would need {:.3g} GB to prepare", particles,
                      particles * bytes_per_particle / 1e9),
          "particles",
          fmt::format("choose a spacing above {:.3g} m or a count below {:g}",
                      std::pow(domain.volume / most_particles, 1.0 / domain.dimension), most_particles));
  for (std::size_t s = 0; s < request.sets.size(); ++s) {
    const auto same = [&](const auto& other) { return other.name == request.sets[s].name; };
    require(!request.sets[s].name.empty(), "a set has no name", "sets", "name it");
    require(std::none_of(request.sets.begin(), request.sets.begin() + s, same) &&
                std::none_of(domain.groups.begin(), domain.groups.end(), same),
            "two sets have one name", fmt::format("set \"{}\"", request.sets[s].name), "rename one of them");
  }
}

const char* name_of(const ParticleRequest& request) {
  switch (request.arrangement) {
  case Arrangement::lattice:
    return request.jitter > 0 ? "jittered" : "lattice";
  case Arrangement::voronoi:
    return "voronoi";
  default:
    return "poisson";
  }
}

void fill_geometry(const TetBody& body, const Arranged& arranged, const CellMeasures& measures,
                   const Shares& shares, const ParticleRequest& request, ParticleCloud& cloud) {
  const Scaling& scaling = body.scaling;
  const std::int64_t n = arranged.size();
  cloud.dimension = body.domain->dimension;
  cloud.domain_volume = body.domain->volume;
  cloud.arrangement = name_of(request);
  cloud.seed = cloud.arrangement == "lattice" ? 0 : request.seed;
  cloud.subvolumes = request.subvolumes == Subvolumes::voronoi ? "voronoi" : "uniform";
  cloud.spacing = arranged.spacing > 0
                      ? arranged.spacing
                      : std::pow(cloud.domain_volume / static_cast<double>(n), 1.0 / cloud.dimension);
  cloud.X = arranged.X;
  cloud.V.resize(n);
  cloud.A.assign(n, Vec3::Zero());
  cloud.centroid.resize(n);
  cloud.cad_dimension.resize(n);
  for_each(n, [&](std::int64_t i) {
    cloud.V[i] = measures.volume[i] * scaling.volume();
    cloud.centroid[i] = arranged.X[i] + measures.moment[i] / measures.volume[i] * scaling.length;
    cloud.cad_dimension[i] = arranged.place[i].dimension;
    for (const SurfaceShare& share : shares[i])
      cloud.A[i] += share.area;
  });
}

Shares in_metres(const CellMeasures& measures, const Scaling& scaling) {
  Shares shares = measures.shares;
  for (auto& of_cell : shares)
    for (SurfaceShare& share : of_cell)
      share.area *= scaling.area();
  return shares;
}

void check_volume(const Quality& quality) {
  if (quality.volume_error < 1e-9)
    return;
  throw InputError(fmt::format("the cells' volumes sum to {:.12g} m^3, the body has {:.12g} m^3",
                               quality.volume_sum, quality.domain_volume),
                   "Voronoi tessellation",
                   "check the mesh for overlapping or inverted parts and remesh the body");
}

/// What a user should hear of: parts of the body finer than the particles, and a count that was missed.
void note_coarse_parts(const ParticleCloud& cloud, const Quality& quality, const ParticleRequest& request,
                       Progress& progress) {
  constexpr double large_correction = 0.1, large_cell = 2.5;
  if (request.arrangement == Arrangement::lattice) {
    const double cell = large_cell * std::pow(cloud.spacing, cloud.dimension);
    const auto large = std::count_if(cloud.V.begin(), cloud.V.end(), [&](double V) { return V > cell; });
    if (large > 0)
      progress.note(
          fmt::format("note: {} particles own more than {:g} lattice cells: parts of the body have no "
                      "particles of their own; choose a smaller spacing",
                      large, large_cell));
  }
  if (quality.area_correction > large_correction)
    progress.note(
        fmt::format("note: the particles are coarse for this boundary: {:.0f} % of its areas had to "
                    "change to balance them; choose a smaller spacing",
                    100 * quality.area_correction));
  const auto wanted = static_cast<double>(request.count), got = static_cast<double>(cloud.size());
  if (request.count > 0 && std::abs(got - wanted) > 0.02 * wanted)
    progress.note(fmt::format("note: {} particles where {} were asked for, {} of them inserted beside slots",
                              cloud.size(), request.count, quality.inserted_particles));
}

struct Tessellated {
  CellMeasures measures;
  std::int64_t inserted = 0; ///< particles
};

/// Cells of the particles. Particles that own nothing go; material across a slot, which no particle on its
/// own side reaches, gets one. Numbers the particles along a Hilbert curve.
Tessellated tessellate(const TetBody& body, const ParticleRequest& request, Arranged& particles,
                       CellMesh& mesh, Stopwatch& watch, Progress& progress) {
  constexpr int most_rounds = 8;
  constexpr double nothing = 1e-9, worth_a_particle = 0.05; ///< parts of the mean cell
  Tessellated result;
  progress.begin("Voronoi cells", most_rounds);
  for (int round = 1;; ++round) {
    particles.keep(hilbert_order(particles.scaled));
    const DelaunayGraph graph = request.backend == Backend::voro ? voro_neighbours(body, particles.scaled)
                                                                 : delaunay_graph(particles.graph_from);
    watch.lap("delaunay");
    stop_if_interrupted("Voronoi cells");
    const RestrictedVoronoi voronoi(body, particles.scaled, graph, request.backend);
    result.measures = measure_cells(voronoi);
    watch.lap("cells");
    progress.advance(round);
    stop_if_interrupted("Voronoi cells");

    const double mean = body.domain->volume / body.scaling.volume() / static_cast<double>(particles.size());
    std::vector<std::int32_t> owning;
    for (std::int32_t i = 0; i < particles.size(); ++i)
      if (result.measures.volume[i] > nothing * mean)
        owning.push_back(i);
    std::vector<Vec3> missing;
    for (const CellMeasures::Orphan& orphan : result.measures.orphans)
      if (orphan.volume > worth_a_particle * mean)
        missing.push_back(orphan.inside);
    const bool complete = missing.empty() && static_cast<std::int64_t>(owning.size()) == particles.size();
    if (complete || round == most_rounds) {
      if (request.keep_cells)
        mesh = collect_cells(voronoi, result.measures);
      break;
    }
    particles.keep(owning);
    for (const Vec3& x : missing)
      particles.insert(x, body);
    result.inserted += static_cast<std::int64_t>(missing.size());
  }
  progress.finish(fmt::format("{} particles", particles.size()));
  return result;
}

} // namespace

Prepared prepare(const Domain& domain, const ParticleRequest& request, Progress& progress) {
  check_request(domain, request);
  Prepared result;
  Stopwatch watch(result.quality);
  const CadTopology cad(domain);
  const TetBody body(domain, scaling_for(domain, usual_spacing(domain, request)));
  watch.lap("body");

  Arranged particles = arrange(body, cad, request, progress);
  const Vec3 size = domain.upper - domain.lower;
  require(particles.size() > domain.dimension,
          fmt::format("fewer than {} particles fit into the body", domain.dimension + 1), "particles",
          fmt::format("choose a spacing well below the body's size of {:.3g} x {:.3g} x {:.3g} m", size[0],
                      size[1], size[2]));
  watch.lap("points");
  stop_if_interrupted("preparing particles");

  const Tessellated cells = tessellate(body, request, particles, result.cells, watch, progress);
  ParticleCloud& cloud = result.cloud;
  Quality& quality = result.quality;
  Shares shares = in_metres(cells.measures, body.scaling);
  fill_geometry(body, particles, cells.measures, shares, request, cloud);
  quality.closure_error = cells.measures.closure_error;
  quality.disconnected_cells = cells.measures.disconnected;
  quality.inserted_particles = cells.inserted;
  quality.stranded_volume = cells.measures.stranded * body.scaling.volume() / domain.volume;
  quality.corners = static_cast<std::int64_t>(domain.corners.size());
  quality.corner_particles = std::count(cloud.cad_dimension.begin(), cloud.cad_dimension.end(), 0);
  assess_cells(domain, cloud, quality);
  check_volume(quality);
  // Lattices pass by oblique and curved surfaces: there, whoever owns area of a surface belongs to it.
  const double least = 1e-6 * std::pow(cloud.spacing, cloud.dimension - 1);
  const auto members = surface_members(domain, cad, particles.place, shares,
                                       request.arrangement == Arrangement::lattice, least);
  gather_on_members(cloud, members, shares);
  quality.area_correction = balance_areas(domain, cloud, shares);
  note_coarse_parts(cloud, quality, request, progress);
  if (request.subvolumes == Subvolumes::uniform) {
    // The cells proved exact above; the particles share the volume alike all the same.
    cloud.V.assign(cloud.X.size(), domain.volume / static_cast<double>(cloud.size()));
    assess_cells(domain, cloud, quality);
  }
  quality.area_imbalance = area_imbalance(cloud);

  look_around(domain, domain.dimension == 2 ? 14 : 30, request.sight, cloud);
  assess_spacing(cloud, particles.h, quality);
  quality.hidden_pairs = static_cast<std::int64_t>(cloud.hidden.pairs().size());
  watch.lap("visibility");
  stop_if_interrupted("preparing particles");

  const SetSource source{domain, cad, cloud, particles.place, shares, members};
  cloud.sets = group_sets(source);
  for (const SetSelector& selector : request.sets)
    cloud.sets.push_back(selected_set(source, selector));
  for (const ParticleSet& set : cloud.sets)
    quality.sets.emplace_back(set.name, static_cast<std::int64_t>(set.particles.size()));
  watch.lap("sets");
  cloud.validate("prepared cloud");
  result.body = body_mesh(domain);
  return result;
}

} // namespace tessera::preprocess
