/// Named sets of particles: from the groups of the CAD file and from the selectors of the case.
#pragma once

#include "core/particle_cloud.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "preprocess/voronoi/cad_topology.hpp"
#include "preprocess/voronoi/cell_measures.hpp"

#include <vector>

namespace tessera::preprocess {

/// What sets are made from. Shares in m^2.
struct SetSource {
  const Domain& domain;
  const CadTopology& cad;
  const ParticleCloud& cloud; ///< X, A and spacing filled
  const std::vector<CadPlace>& place;
  const std::vector<std::vector<SurfaceShare>>& shares;
  /// Lattices pass by oblique and curved surfaces: there, whoever owns area of a surface belongs to it. On
  /// irregular clouds particles lie on every surface: those are its set, and what others own of it goes to
  /// the nearest of them.
  bool owners_belong;
};

/// One set per group of the domain; where no group names surfaces, also one per CAD surface. The areas of a
/// set of surfaces sum to the area vectors of its surfaces.
std::vector<ParticleSet> group_sets(const SetSource& source);

/// The set a selector describes. A plane's areas are those of the CAD surfaces that lie in it; a box's and a
/// nearest particle's are the whole boundary areas of its particles. InputError where no particle is
/// selected.
ParticleSet selected_set(const SetSource& source, const SetSelector& selector);

} // namespace tessera::preprocess
