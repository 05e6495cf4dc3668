/// Named sets of particles: from the groups of the CAD file and from the selectors of the case.
#pragma once

#include "core/particle_cloud.hpp"
#include "preprocess/cloud/boundary_areas.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "preprocess/voronoi/cad_topology.hpp"

#include <vector>

namespace tessera::preprocess {

/// What sets are made from. Shares in m^2, balanced: they sum to the cloud's A.
struct SetSource {
  const Domain& domain;
  const CadTopology& cad;
  const ParticleCloud& cloud; ///< X, A and spacing filled
  const std::vector<CadPlace>& place;
  const Shares& shares;
  const std::vector<std::vector<std::int32_t>>& members; ///< by surface; they alone have shares of it
};

/// One set per group of the domain; where no group names surfaces, also one per CAD surface. The areas of a
/// set of surfaces are its particles' shares of them.
std::vector<ParticleSet> group_sets(const SetSource& source);

/// The set a selector describes. A plane's areas are those of the CAD surfaces that lie in it, whose
/// particles belong to it; a box's and a nearest particle's are the whole boundary areas of its particles.
/// InputError where no particle is selected.
ParticleSet selected_set(const SetSource& source, const SetSelector& selector);

} // namespace tessera::preprocess
