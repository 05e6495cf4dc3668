/// How far a run is from a closed form.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/scene/scene.hpp"

#include <span>

namespace tessera::solver {

/// A run's last fields, particle by particle.
struct FinalFields {
  std::span<const double> displacement; ///< particles x 3, m
  std::span<const double> velocity;     ///< particles x 3, m/s
  std::span<const double> pressure;     ///< Pa
};

/// Norms (5.3) at `time` (s), relative ones over the norm of the exact field. Evaluated at the reference
/// positions.
ErrorNorms error_norms(const ExactSolution& exact, double time, const ParticleCloud& cloud,
                       const FinalFields& fields);

} // namespace tessera::solver
