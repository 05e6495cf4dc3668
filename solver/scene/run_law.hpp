/// A run with its law chosen: one instantiation a law, each compiled in a file of its own under laws/.
#pragma once

#include "core/particle_cloud.hpp"
#include "core/progress.hpp"
#include "solver/scene/scene.hpp"

namespace tessera::solver {

/// As run() of scene.hpp.
template <class L>
Summary run_law(const L& law, const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                Progress& progress);

/// As forecast() of scene.hpp.
template <class L>
Forecast forecast_law(const L& law, const SceneSpec& scene, const ParticleCloud& cloud);

} // namespace tessera::solver
