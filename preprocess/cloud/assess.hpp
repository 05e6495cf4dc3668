/// Measures a finished cloud for its Quality.
#pragma once

#include "core/particle_cloud.hpp"
#include "preprocess/cloud/quality.hpp"
#include "preprocess/geometry/domain.hpp"
#include "preprocess/voronoi/delaunay.hpp"

namespace tessera::preprocess {

/// Fills all that follows from the cloud and its neighbours; `h` (m) is the unit of spacing_min_over_h.
void assess(const Domain& domain, const ParticleCloud& cloud, const DelaunayGraph& graph, double h,
            Quality& quality);

} // namespace tessera::preprocess
