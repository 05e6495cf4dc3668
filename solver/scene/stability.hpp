/// How long a step a scene's body bears: what its operators amplify, at rest and evenly stretched.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/scene/scene.hpp"
#include "solver/time/spectrum.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace tessera::solver {

struct StabilityFindings {
  std::string formulation, scheme, dissipation, integrator;
  std::int64_t particles = 0;
  double neighbours_mean = 0;
  StepChoice step;                  ///< as a run finds it for the body as it is stretched
  double dt = 0;                    ///< a run's step then, s
  std::int64_t unknowns = 0;        ///< of the operators: rows of their matrix
  std::optional<Spectrum> spectrum; ///< of bodies of at most `largest_matrix` unknowns
};

/// Of the scene's body at rest, pulled to the principal stretches along X, Y and Z. Walls, loads and initial
/// conditions play no part, held velocities do.
StabilityFindings stability(const SceneSpec& scene, const ParticleCloud& cloud, const Vec3& stretch);

} // namespace tessera::solver
