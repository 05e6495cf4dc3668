#include "solver/scene/graph.hpp"

#include "core/error.hpp"
#include "solver/operators/support.hpp"

#include <fmt/format.h>

namespace tessera::solver {

template <int D>
Neighbours build_graph(const SceneSpec& scene, const ParticleCloud& cloud) {
  // Balanced operators err least with few neighbours (docs/theory.md).
  const double lattice_support = scene.scheme == "consistent" ? 1.6 : 2.2;
  constexpr int usual_neighbours = D == 2 ? 14 : 30;
  const auto supported = [&] {
    if (scene.support)
      return uniform_support(cloud.X, *scene.support * cloud.spacing, cloud.hidden);
    if (cloud.arrangement == "lattice")
      return uniform_support(cloud.X, lattice_support * cloud.spacing, cloud.hidden);
    const int neighbours = scene.neighbours > 0 ? scene.neighbours : usual_neighbours;
    return adaptive_support<D>(cloud.X, cloud.V, neighbours, cloud.hidden, {kernel_named(scene.kernel)});
  };
  Neighbours graph = supported();
  for (std::size_t a = 0; a < cloud.sight.size(); ++a)
    require(
        graph.support[a] <= cloud.sight[a],
        fmt::format("particle {} has a support of {:.4g} m, but which others it sees past slots and holes "
                    "is known up to {:.4g} m only",
                    a, graph.support[a], cloud.sight[a]),
        "cloud", "prepare the cloud with particles.sight as large, or ask for a smaller support");
  return graph;
}

template Neighbours build_graph<2>(const SceneSpec&, const ParticleCloud&);
template Neighbours build_graph<3>(const SceneSpec&, const ParticleCloud&);

} // namespace tessera::solver
