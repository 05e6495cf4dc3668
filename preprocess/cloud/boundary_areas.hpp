/// Area vectors that integrate linear fields exactly over the particles.
#pragma once

#include "core/particle_cloud.hpp"

namespace tessera::preprocess {

/// Changes cloud.A as little as possible (least squares, weighted by 1 / |A_a|) so that
///
///     sum A_a = 0   and   sum X_a (x) A_a = (sum V_a) I,
///
/// which the exact boundary integrals of 1 and x satisfy, but sums over particles do not: a patch's area acts
/// at the particle that owns it, not where the patch lies. Without both, no operator can balance a constant
/// stress. In the plane, I is that of the plane. Returns sum |change| / sum |A|; InputError where the owning
/// particles lie in one plane (in the plane: on one line).
double balance_areas(ParticleCloud& cloud);

/// The larger of |sum A| / sum |A| and |sum X (x) A - (sum V) I| / sum V.
double area_imbalance(const ParticleCloud& cloud);

} // namespace tessera::preprocess
