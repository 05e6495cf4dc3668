/// What the particles own of each CAD surface, as parts of area vectors that integrate linear fields exactly.
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
