/// Parts of cells that do not hang together with their seed: material across a slot or a notch.
#pragma once

#include "preprocess/voronoi/cell_measures.hpp"

#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Takes the far parts from the cells in `split` (ascending; cells that visit() shows in several components)
/// and hands them on: fills result.orphans, .disconnected and .stranded, and moves volume, moment and shares.
void hand_over_orphans(const RestrictedVoronoi& voronoi, const std::vector<std::int64_t>& split,
                       CellMeasures& result);

/// Adds to the share of a surface; lids have none.
void add_share(std::vector<SurfaceShare>& shares, std::int32_t surface, const Vec3& area);

} // namespace tessera::preprocess
