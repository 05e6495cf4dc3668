/// Irregular clouds in two passes: random seeds, then the vertices of their restricted Voronoi cells as
/// particles.
#pragma once

#include "core/progress.hpp"
#include "preprocess/seeding/size_field.hpp"
#include "preprocess/voronoi/merge.hpp"

#include <cstdint>

namespace tessera::preprocess {

struct TwoPassRequest {
  std::int64_t count = 0;
  double merge = 0.5; ///< vertices nearer than merge * h * size become one
  std::uint64_t seed = 1;
  SizeField size;      ///< relative spacing; empty: uniform
  int relax_seeds = 0; ///< Lloyd sweeps on the seeds
};

struct TwoPass {
  PlacedPoints points;    ///< merged, in the body's scaled coordinates
  std::int64_t seeds = 0; ///< drawn
  double h = 0;           ///< (graded volume / vertices before merging)^(1/dimension), m
};

/// Particles of a two-pass cloud of about `count` points: the number of seeds is corrected until the count is
/// within 2 % or cannot come nearer. Every try uses the first seeds of one random stream.
TwoPass two_pass_points(const TetBody& body, const CadTopology& cad, const TwoPassRequest& request,
                        Progress& progress);

} // namespace tessera::preprocess
