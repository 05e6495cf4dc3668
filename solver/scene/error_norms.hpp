/// How far a run is from a closed form.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/scene/scene.hpp"

#include <span>

namespace tessera::solver {

/// Norms (5.3) at `time` (s), relative ones over the norm of the exact field. `velocity`: particles x 3, m/s;
/// `pressure`: Pa. Evaluated at the reference positions.
ErrorNorms error_norms(const ExactSolution& exact, double time, const ParticleCloud& cloud,
                       std::span<const double> velocity, std::span<const double> pressure);

} // namespace tessera::solver
