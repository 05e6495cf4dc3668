/// Which particles stand for a CAD surface, and what of it is theirs.
#pragma once

#include "core/particle_cloud.hpp"
#include "preprocess/geometry/domain.hpp"
#include "preprocess/voronoi/cad_topology.hpp"
#include "preprocess/voronoi/cell_measures.hpp"

#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// By particle: its parts of the surfaces, m^2, surfaces ascending.
using Shares = std::vector<std::vector<SurfaceShare>>;

/// The particles of each CAD surface, ascending: those that lie on it and, where `owners_belong` or none
/// lies on it, those whose cells reach it. `least` (m^2): shares below it are rounding where a cell ends.
std::vector<std::vector<std::int32_t>> surface_members(const Domain& domain, const CadTopology& cad,
                                                       const std::vector<CadPlace>& place,
                                                       const Shares& shares, bool owners_belong,
                                                       double least);

/// Gives what others own of a surface to its members near by, in proportion to their volumes: a small cell
/// with much surface would be light and hard pushed.
void gather_on_members(const ParticleCloud& cloud, const std::vector<std::vector<std::int32_t>>& members,
                       Shares& shares);

} // namespace tessera::preprocess
