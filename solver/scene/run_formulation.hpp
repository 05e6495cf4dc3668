/// A run with its formulation chosen: each is compiled in a file of its own under formulations/.
#pragma once

#include "core/particle_cloud.hpp"
#include "core/progress.hpp"
#include "solver/scene/forecast.hpp"
#include "solver/scene/scene.hpp"
#include "solver/scene/stability.hpp"

namespace tessera::solver {

/// As run() of scene.hpp.
template <class Formulation>
Summary run_formulation(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                        Progress& progress);

/// As forecast() of forecast.hpp.
template <class Formulation>
Forecast forecast_formulation(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs);

/// As stability() of stability.hpp.
template <class Formulation>
StabilityFindings stability_formulation(const SceneSpec& scene, const ParticleCloud& cloud,
                                        const Vec3& stretch);

} // namespace tessera::solver
