/// What a scene's body is made of, in words: what is modelled, what is left out, and why.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/scene/forecast.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace tessera::solver {

/// A body, whatever its types.
struct BodyTraits {
  int dimension = 3;
  std::string formulation, title; ///< "pF", "{p, F}"
  bool evolves_F = false, evolves_H = false, evolves_J = false;
  bool dissipates = false, dissipates_J = false;
  std::int64_t blind = 0; ///< particles the dissipation does not see
  PlasticRamp kappa = PlasticRamp::constant(0);
  double kappa_J = 0;
  double support = 0;           ///< largest kernel radius, m
  double smallest_distance = 0; ///< of two particles, m
};

/// Fills in modelled, left_out and, from the step and the neighbours that are known, choices.
void explain(const SceneSpec& scene, const ParticleCloud& cloud, const BodyTraits& body, Forecast& forecast);

} // namespace tessera::solver
