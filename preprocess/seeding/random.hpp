/// Points spread uniformly over a body.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <cstdint>
#include <random>
#include <vector>

namespace tessera::preprocess {

/// A stream of uniform random points of a body: the first n points are the same whatever is drawn after them,
/// on any machine and library (the Mersenne twister's bits are mapped to numbers here). Four numbers a point,
/// none rejected: one picks the tetrahedron by volume, three fold the unit cube onto it.
class RandomPoints {
 public:
  RandomPoints(const Domain& domain, std::uint64_t seed);
  Vec3 next(); ///< m

 private:
  double uniform(); ///< in [0, 1), 53 bits
  const Domain* domain_;
  std::vector<double> volume_up_to_;
  std::mt19937_64 bits_;
};

} // namespace tessera::preprocess
