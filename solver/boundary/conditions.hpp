/// What acts on a body from outside.
#pragma once

#include "solver/boundary/held_velocity.hpp"
#include "solver/boundary/loads.hpp"
#include "solver/boundary/wall.hpp"

#include <memory>
#include <vector>

namespace tessera::solver {

template <int D>
struct Conditions {
  std::vector<Vec3> X; ///< reference positions, m; empty without loads
  HeldVelocities<D> held;
  std::vector<std::unique_ptr<Load<D>>> loads;
  std::vector<Wall<D>> walls;
};

} // namespace tessera::solver
