/// Points spread over a body at random.
#pragma once

#include "preprocess/seeding/graded_parts.hpp"

#include <cstdint>
#include <random>
#include <vector>

namespace tessera::preprocess {

/// Numbers in [0, 1) of 53 bits, the same on any machine and library: the Mersenne twister's bits are mapped
/// to numbers here.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : bits_(seed) {}
  double next() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 bits_;
};

/// A stream of random points of a body: the first n points are the same whatever is drawn after them.
/// Uniform, or with the density size^-dimension. Uniform points take four numbers each, none rejected: one
/// picks the tetrahedron by volume, three fold the unit cube onto it. Points of a slab lie at z = 0.
class RandomPoints {
 public:
  RandomPoints(const Domain& domain, std::uint64_t seed, SizeField size = {});
  Vec3 next(); ///< m

 private:
  Vec3 in_tetrahedron(const std::array<Vec3, 4>& X);
  std::size_t pick();

  const Domain* domain_;
  SizeField size_;
  std::vector<GradedPart> parts_;   ///< empty: uniform, by the domain's tetrahedra
  std::vector<double> share_up_to_; ///< running sum of the parts' integrals, or of the tetrahedra's volumes
  RandomNumbers numbers_;
};

} // namespace tessera::preprocess
