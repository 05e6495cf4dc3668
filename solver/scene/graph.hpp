/// Who a particle's neighbours are, as a scene asks for it.
#pragma once

#include "core/neighbours.hpp"
#include "core/particle_cloud.hpp"
#include "solver/scene/scene.hpp"

namespace tessera::solver {

/// The graph a scene's `support` or `neighbours` asks for.
///
/// Throws InputError where a support reaches farther than the cloud's particles were tested to see each
/// other.
template <int D>
Neighbours build_graph(const SceneSpec& scene, const ParticleCloud& cloud);

} // namespace tessera::solver
