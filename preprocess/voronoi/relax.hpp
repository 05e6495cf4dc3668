/// Lloyd's sweeps: points move to the centroids of their restricted Voronoi cells until they are evenly
/// spread.
#pragma once

#include "core/progress.hpp"
#include "preprocess/seeding/size_field.hpp"
#include "preprocess/voronoi/vertices.hpp"

#include <vector>

namespace tessera::preprocess {

/// Free seeds after `sweeps` over-relaxed sweeps, in the body's scaled coordinates (z = 0 in a slab). Each
/// moves past the centroid of the part of its cell that hangs together with it, but never out of the body: a
/// move through the boundary is halved until it stays inside.
std::vector<Vec3> relaxed_seeds(const TetBody& body, const CadTopology& cad, std::vector<Vec3> seeds,
                                const SizeField& size, int sweeps, Progress& progress);

/// Particles after `sweeps` constrained sweeps. Corners stay. Those on a CAD curve spread evenly along it,
/// between the corners it ends in. Those on a CAD surface move to the centroid of the part of it they own,
/// put back onto its facets. Inner ones move to the centroid of their cell. All by the size field's weights,
/// each within the part of the body it hangs together with, so that slots are never crossed.
PlacedPoints relaxed(const TetBody& body, const CadTopology& cad, PlacedPoints particles,
                     const SizeField& size, int sweeps, Progress& progress);

} // namespace tessera::preprocess
