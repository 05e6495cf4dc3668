/// Laws with constants of their own to try things on.
#pragma once

#include "solver/physics/materials/hencky.hpp"
#include "solver/physics/materials/linear_elastic.hpp"
#include "solver/physics/materials/mooney_rivlin.hpp"
#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/materials/ogden.hpp"
#include "solver/physics/materials/saint_venant_kirchhoff.hpp"

#include <type_traits>

namespace tessera::test {

template <class L>
L example_law() {
  using namespace tessera::solver;
  if constexpr (std::is_same_v<L, MooneyRivlin>)
    return {2e6, 0.7e6, 12e6};
  else if constexpr (std::is_same_v<L, Ogden>)
    return {{{0.63e6, 1.3}, {0.0012e6, 5}, {-0.01e6, -2}}, 8e6};
  else
    return {ElasticConstants::from(17e6, 0.3)};
}

} // namespace tessera::test
