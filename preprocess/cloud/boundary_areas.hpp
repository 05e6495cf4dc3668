/// Boundary areas that integrate linear fields exactly over the particles, and their parts by CAD surface.
#pragma once

#include "core/particle_cloud.hpp"
#include "preprocess/cloud/surface_members.hpp"
#include "preprocess/geometry/domain.hpp"

namespace tessera::preprocess {

/// Changes the shares as little as possible (least squares, weighted by 1 / |share|) and makes cloud.A their
/// sums, so that
///
///     sum A_a = 0   and   sum X_a (x) A_a = (sum V_a) I,
///
/// which the exact boundary integrals of 1 and x satisfy, but sums over particles do not: a patch's area acts
/// at the particle that owns it, not where the patch lies. Without both, no operator can balance a constant
/// stress. In the plane, I is that of the plane.
///
/// First surface by surface: the shares of a flat one keep its normal and sum to its area and its first
/// moment, those of a curved one to the integrals of n and X (x) n, so that the resultant and the moment of a
/// uniform load on it are exact. What particles beside their surface (lattices) and surfaces of too few
/// particles leave is taken by all surfaces together, flat ones keeping their normals as long as that can be.
///
/// Returns sum |change| / sum |share|; InputError where the owning particles lie in one plane (in the plane:
/// on one line).
double balance_areas(const Domain& domain, ParticleCloud& cloud, Shares& shares);

/// The larger of |sum A| / sum |A| and |sum X (x) A - (sum V) I| / sum V.
double area_imbalance(const ParticleCloud& cloud);

} // namespace tessera::preprocess
