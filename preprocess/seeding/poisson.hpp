/// Poisson-disk clouds: random particles, no two too near, no room left for another.
#pragma once

#include "core/progress.hpp"
#include "preprocess/seeding/size_field.hpp"
#include "preprocess/voronoi/vertices.hpp"

#include <cstdint>

namespace tessera::preprocess {

struct PoissonRequest {
  std::int64_t count = 0;
  std::uint64_t seed = 1;
  SizeField size; ///< relative spacing; empty: uniform
};

struct PoissonCloud {
  PlacedPoints points; ///< in the body's scaled coordinates
  double radius = 0;   ///< m, where the size is 1
};

/// About `count` particles: all CAD corners, then points of the CAD curves, of the surfaces and of the
/// inside, no two nearer than radius * size by the rules of `merged`, and of each hardly any point farther
/// than that from one it would have to yield to. The radius is corrected until the count is within 2 %.
PoissonCloud poisson_points(const TetBody& body, const CadTopology& cad, const PoissonRequest& request,
                            Progress& progress);

} // namespace tessera::preprocess
