/// Who sees whom in a body with slots, holes and gaps.
#pragma once

#include "core/hidden_pairs.hpp"
#include "core/particle_cloud.hpp"
#include "preprocess/geometry/domain.hpp"

#include <vector>

namespace tessera::preprocess {

/// Pairs of particles within the sight (m) of one of them that must not interact: the straight way from one
/// cell's centroid to the other's leaves the body. Centroids and not the particles themselves, because those
/// lie on the boundary: along a curved wall their chord would leave the body by a hair.
///
/// Only particles around whom the body is not convex are looked at, so a convex body costs next to nothing.
/// A particle whose eye cannot be placed inside the body sees all.
HiddenPairs hidden_pairs(const Domain& domain, const ParticleCloud& cloud, const std::vector<double>& sight);

/// Sets cloud.sight and cloud.hidden, far enough for a support that holds `neighbours` visible others on an
/// irregular cloud, or of `reach` spacings on a lattice, with some margin.
void look_around(const Domain& domain, int neighbours, double reach, ParticleCloud& cloud);

} // namespace tessera::preprocess
