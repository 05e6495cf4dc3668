/// A body cut into tetrahedra on each of which the particles wanted are spread almost evenly.
#pragma once

#include "preprocess/seeding/size_field.hpp"

#include <array>
#include <vector>

namespace tessera::preprocess {

struct GradedPart {
  std::array<Vec3, 4> corners; ///< m
  double integral;             ///< of size^-dimension, m^dimension
  double most;                 ///< hardly exceeded by size^-dimension
};

/// In an order that depends on the domain alone. Sizes of a slab are those at z = 0.
std::vector<GradedPart> graded_parts(const Domain& domain, const SizeField& size);

} // namespace tessera::preprocess
