/// Who sees whom in a body with slots, holes and gaps.
#pragma once

#include "core/particle_cloud.hpp"
#include "preprocess/geometry/domain.hpp"

namespace tessera::preprocess {

/// Sets cloud.sight and cloud.hidden. Sight is `reach` spacings on a lattice (3.2 where reach is 0), and on
/// an irregular cloud `reach` times (1.5 where it is 0) the distance to the `neighbours`-th visible other.
///
/// Two particles must not interact if the straight way from one cell's centroid to the other's leaves the
/// body. Centroids and not the particles themselves, because those lie on the boundary: along a curved wall
/// their chord would leave the body by a hair. Only particles around whom the body is not convex are looked
/// at, so a convex body costs next to nothing. A particle whose eye cannot be placed inside the body sees
/// all.
void look_around(const Domain& domain, int neighbours, double reach, ParticleCloud& cloud);

} // namespace tessera::preprocess
