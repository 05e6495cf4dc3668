/// First pass of a two-pass cloud: the vertices of the restricted Voronoi cells of random seeds.
#pragma once

#include "preprocess/voronoi/cad_topology.hpp"
#include "preprocess/voronoi/restricted_voronoi.hpp"

#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Points with their place on the CAD model, lower dimensions first.
struct PlacedPoints {
  std::vector<Vec3> X; ///< in the body's scaled coordinates
  std::vector<CadPlace> place;

  std::int64_t size() const { return static_cast<std::int64_t>(X.size()); }
  void add(const Vec3& x, const CadPlace& where) {
    X.push_back(x);
    place.push_back(where);
  }
};

/// In this order: the CAD corners; on each CAD curve the points between two cells; on each CAD surface the
/// points between three; inside, the points between four. Cuts by the tetrahedra's own inner faces leave no
/// trace. Each point is equally far from its seeds to rounding. In a slab, all at z = 0: the corners; on each
/// wall the points between two cells; inside, the points between three.
PlacedPoints cell_vertices(const RestrictedVoronoi& voronoi);

} // namespace tessera::preprocess
