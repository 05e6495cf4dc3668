/// Small disturbances of a body at rest, as matrices.
#pragma once

#include "core/tensor.hpp"

namespace tessera::solver {

/// du/dt = v,  dv/dt = -K u - C v + B J,  dJ/dt = G v + pull (G u - J) + D J  of displacements, velocities
/// and, where it is evolved, the volume map, without further flow of the material. Only directions that no
/// condition holds are kept, each times sqrt(V), in which the operators of the consistent scheme are
/// symmetric. H, where it is evolved, strays from cof F on its own and comes back at the rate `pull`. In
/// units of a length and a time, so that all entries are of order one.
struct Linearised {
  Eigen::MatrixXd K, C;
  Eigen::MatrixXd B, G, D; ///< empty unless J is evolved
  Eigen::VectorXd pull;    ///< one a particle that evolves J; of H too
  bool evolves_H = false;
  double length = 1, time = 1; ///< the units, m and s
};

} // namespace tessera::solver
