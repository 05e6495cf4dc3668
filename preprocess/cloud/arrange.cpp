#include "preprocess/cloud/arrange.hpp"

#include "preprocess/cloud/renumber.hpp"
#include "preprocess/seeding/body_boxes.hpp"
#include "preprocess/seeding/poisson.hpp"
#include "preprocess/seeding/random.hpp"
#include "preprocess/voronoi/relax.hpp"
#include "preprocess/voronoi/two_pass.hpp"

#include <cmath>

namespace tessera::preprocess {
namespace {

/// Puts points of the CAD model back on it to the last bit: corners, and coordinates that all vertices of
/// their surface share.
class Snap {
 public:
  Snap(const Domain& domain, const CadTopology& cad) : domain_(domain), cad_(cad) {
    const double nan = std::nan("");
    constant_.assign(domain.surfaces.size(), Vec3::Constant(nan));
    std::vector<bool> seen(domain.surfaces.size(), false);
    for (const auto& facet : domain.facets) {
      if (facet.surface == Domain::lid)
        continue;
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
  }
  Vec3 operator()(Vec3 X, const CadPlace& place) const {
    if (place.dimension == 0) {
      X = domain_.vertices[place.entity];
    } else {
      for (const std::int32_t s : cad_.surfaces_of(place))
        for (int a = 0; a < 3; ++a)
          if (!std::isnan(constant_[s][a]))
            X[a] = constant_[s][a];
    }
    if (domain_.dimension == 2)
      X[2] = 0;
    return X;
  }

 private:
  const Domain& domain_;
  const CadTopology& cad_;
  std::vector<Vec3> constant_; ///< by surface: the coordinates all its vertices share, NaN where they differ
};

/// Moves the particles that lie on no face, edge or corner by up to `share` spacings along each axis; those
/// it would lead out of the body stay.
void jitter(Arranged& lattice, const TetBody& body, double share, std::uint64_t seed) {
  const BodyBoxes inside(body);
  const int dimension = body.domain->dimension;
  RandomNumbers numbers(seed);
  for (std::int64_t i = 0; i < lattice.size(); ++i) {
    Vec3 X = lattice.X[i];
    for (int c = 0; c < dimension; ++c)
      X[c] += share * lattice.spacing * (2 * numbers.next() - 1);
    const Vec3 scaled = body.scaling.in(X);
    if (lattice.place[i].dimension < dimension || !inside.holds(scaled))
      continue;
    lattice.X[i] = X;
    lattice.scaled[i] = scaled;
  }
  lattice.graph_from = lattice.scaled; // no lattice any more
}

Arranged arrange_lattice(const TetBody& body, const CadTopology& cad, const ParticleRequest& request) {
  const LatticeSpec spec = request.count > 0
                               ? lattice_for_count(*body.domain, cad, request.lattice, request.count).spec
                               : LatticeSpec{request.lattice, request.spacing, Vec3::Zero()};
  const Lattice lattice = lattice_points(*body.domain, cad, spec);
  Arranged result;
  const std::size_t n = lattice.index.size();
  for (std::size_t i = 0; i < n; ++i) {
    result.X.push_back(lattice.position(i));
    result.scaled.push_back(body.scaling.in(result.X.back()));
    result.graph_from.push_back(lattice.whole_numbers(i));
  }
  result.place = lattice.place;
  result.spacing = result.h = spec.spacing;
  if (request.jitter > 0)
    jitter(result, body, request.jitter, request.seed);
  return result;
}

Arranged arrange_irregular(const TetBody& body, const CadTopology& cad, const ParticleRequest& request,
                           Progress& progress) {
  const Domain& domain = *body.domain;
  const SizeField size = size_field(domain, request.refine, request.sizes_from_mesh);
  const std::int64_t count =
      request.count > 0
          ? request.count
          : std::llround(graded_volume(domain, size) / std::pow(request.spacing, domain.dimension));
  PlacedPoints points;
  Arranged result;
  if (count < 1)
    return result;
  if (request.arrangement == Arrangement::poisson) {
    PoissonCloud cloud = poisson_points(body, cad, {count, request.seed, size}, progress);
    points = std::move(cloud.points);
    result.h = cloud.radius;
  } else {
    TwoPass cloud =
        two_pass_points(body, cad, {count, request.merge, request.seed, size, request.relax_seeds}, progress);
    points = std::move(cloud.points);
    result.h = cloud.h;
  }
  if (request.relax > 0)
    points = relaxed(body, cad, std::move(points), size, request.relax, progress);
  const Snap snap(domain, cad);
  for (std::int64_t i = 0; i < points.size(); ++i) {
    result.X.push_back(snap(body.scaling.out(points.X[i]), points.place[i]));
    result.scaled.push_back(body.scaling.in(result.X.back()));
  }
  result.graph_from = result.scaled;
  result.place = std::move(points.place);
  return result;
}

} // namespace

void Arranged::keep(const std::vector<std::int32_t>& order) {
  X = permuted(X, order);
  scaled = permuted(scaled, order);
  graph_from = permuted(graph_from, order);
  place = permuted(place, order);
}

void Arranged::insert(const Vec3& where, const TetBody& body) {
  X.push_back(body.scaling.out(where));
  if (body.domain->dimension == 2)
    X.back().z() = 0;
  scaled.push_back(body.scaling.in(X.back()));
  place.push_back({static_cast<std::uint8_t>(body.domain->dimension), -1});
  graph_from = scaled; // no lattice any more
}

double usual_spacing(const Domain& domain, const ParticleRequest& request) {
  return request.spacing > 0
             ? request.spacing
             : std::pow(domain.volume / static_cast<double>(request.count), 1.0 / domain.dimension);
}

Arranged arrange(const TetBody& body, const CadTopology& cad, const ParticleRequest& request,
                 Progress& progress) {
  return request.arrangement == Arrangement::lattice ? arrange_lattice(body, cad, request)
                                                     : arrange_irregular(body, cad, request, progress);
}

} // namespace tessera::preprocess
