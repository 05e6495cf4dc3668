/// Where the particles lie, before their cells are known.
#pragma once

#include "core/progress.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "preprocess/voronoi/cad_topology.hpp"
#include "preprocess/voronoi/tet_body.hpp"

#include <vector>

namespace tessera::preprocess {

struct Arranged {
  std::vector<Vec3> X;          ///< m
  std::vector<Vec3> scaled;     ///< the same in the body's coordinates
  std::vector<Vec3> graph_from; ///< what neighbours are found from: a lattice's whole numbers, else `scaled`
  std::vector<CadPlace> place;
  double spacing = 0; ///< of a lattice, m; 0 elsewhere
  double h = 0;       ///< unit of the smallest distance: lattice spacing, or what merging or filling used, m

  std::int64_t size() const { return static_cast<std::int64_t>(X.size()); }
  /// Those listed, in that order.
  void keep(const std::vector<std::int32_t>& order);
  /// One more, inside the body (its scaled coordinates).
  void insert(const Vec3& where, const TetBody& body);
};

/// The spacing (m) that the size of a body's cells is measured in: what was asked for, or follows from
/// `count`.
double usual_spacing(const Domain& domain, const ParticleRequest& request);

/// Points as the request arranges them, relaxed if asked, in no particular order.
Arranged arrange(const TetBody& body, const CadTopology& cad, const ParticleRequest& request,
                 Progress& progress);

} // namespace tessera::preprocess
