/// Measures a finished cloud for its Quality.
#pragma once

#include "core/particle_cloud.hpp"
#include "preprocess/cloud/quality.hpp"
#include "preprocess/geometry/domain.hpp"

namespace tessera::preprocess {

/// Fills what follows from the particles' volumes, areas and centroids.
void assess_cells(const Domain& domain, const ParticleCloud& cloud, Quality& quality);

/// Fills what follows from each particle's distance to the nearest other it sees; `h` (m) is the unit of
/// spacing_min_over_h.
void assess_spacing(const ParticleCloud& cloud, double h, Quality& quality);

} // namespace tessera::preprocess
