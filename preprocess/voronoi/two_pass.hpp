/// Irregular clouds in two passes: random seeds, then the vertices of their restricted Voronoi cells as
/// particles.
#pragma once

#include "core/progress.hpp"
#include "preprocess/voronoi/merge.hpp"

#include <cstdint>

namespace tessera::preprocess {

struct TwoPass {
  PlacedPoints points;    ///< merged, in the body's scaled coordinates
  std::int64_t seeds = 0; ///< drawn
  double h = 0;           ///< (volume / vertices before merging)^(1/3), m: the unit of the merge radius
};

/// Particles of a two-pass cloud of about `count` points: the number of seeds is corrected until the count is
/// within 2 % or cannot come nearer. Every try uses the first seeds of one random stream.
TwoPass two_pass_points(const TetBody& body, const CadTopology& cad, std::int64_t count, double merge,
                        std::uint64_t seed, Progress& progress);

} // namespace tessera::preprocess
