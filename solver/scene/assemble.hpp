/// From a scene and its cloud to a body, its conditions and its step length.
#pragma once

#include "core/error.hpp"
#include "core/particle_cloud.hpp"
#include "solver/operators/support.hpp"
#include "solver/physics/body.hpp"
#include "solver/physics/law.hpp"
#include "solver/scene/scene.hpp"
#include "solver/time/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tessera::solver {

/// Everything a run needs, of the types the scene chose.
template <class Body>
struct Assembly {
  Body body;
  Step<Body> step;
  double smallest_distance; ///< between two particles, m: Delta of (3.93) and (3.85)
};

/// The graph a scene's `support` or `neighbours` asks for.
///
/// Throws InputError where a support reaches farther than the cloud's particles were tested to see each
/// other.
template <int D>
Neighbours build_graph(const SceneSpec& scene, const ParticleCloud& cloud) {
  constexpr double lattice_support = 2.2;
  constexpr int usual_neighbours = D == 2 ? 14 : 30;
  const auto supported = [&] {
    if (scene.support)
      return uniform_support(cloud.X, *scene.support * cloud.spacing, cloud.hidden);
    if (cloud.arrangement == "lattice")
      return uniform_support(cloud.X, lattice_support * cloud.spacing, cloud.hidden);
    const int neighbours = scene.neighbours > 0 ? scene.neighbours : usual_neighbours;
    return adaptive_support<D>(cloud.X, cloud.V, neighbours, cloud.hidden,
                               Kernel<D>{kernel_named(scene.kernel)});
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

template <int D>
std::vector<Vec<D>> initial_momenta(const SceneSpec& scene, const ParticleCloud& cloud) {
  std::vector<Vec<D>> p(cloud.X.size(), Vec<D>::Zero());
  const auto set_one = [&](const InitialVelocity& initial, std::size_t a) {
    for (int c = 0; c < D; ++c)
      p[a][c] = scene.material.density * initial.velocity[c](cloud.X[a]);
  };
  for (const InitialVelocity& initial : scene.initial) {
    if (initial.on == "all")
      for (std::size_t a = 0; a < p.size(); ++a)
        set_one(initial, a);
    else
      for (std::int32_t a : cloud.set(initial.on).particles)
        set_one(initial, static_cast<std::size_t>(a));
  }
  return p;
}

template <int D>
std::vector<Fixed<D>> fixed_conditions(const SceneSpec& scene, const ParticleCloud& cloud) {
  std::vector<Fixed<D>> fixed;
  for (const FixedCondition& c : scene.fixed)
    fixed.push_back({cloud.set(c.on).particles, c.component});
  return fixed;
}

template <int D>
std::vector<Plane<D>> plane_walls(const SceneSpec& scene, const ParticleCloud& cloud) {
  std::vector<Plane<D>> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const PlaneWall& wall = scene.walls[i];
    const Plane<D> plane{wall.point.head<D>(), Vec<D>(wall.normal.head<D>()).normalized(), wall.restitution};
    for (std::size_t a = 0; a < cloud.X.size(); ++a)
      require(plane.gap(cloud.X[a].head<D>()) > -0.5 * cloud.spacing,
              "the body begins behind a wall: particle " + std::to_string(a) +
                  " is on the far side of wall " + std::to_string(i),
              "", "move the wall, or turn its normal to the side the body is on");
    walls.push_back(plane);
  }
  return walls;
}

/// Calls use(assembly) with the types the scene asks for.
template <int D, ConstitutiveLaw L, class Use>
auto with_dissipation(const SceneSpec& scene, const ParticleCloud& cloud, const L& law, Use&& use) {
  Neighbours graph = build_graph<D>(scene, cloud);
  const Kernel<D> kernel{kernel_named(scene.kernel)};
  Gradient<D> gradient = build_gradient<D>(cloud.X, cloud.V, graph, kernel);
  const std::vector<double> nearest = distance_to_nearest(cloud.X, 1, cloud.hidden);
  const double smallest = *std::min_element(nearest.begin(), nearest.end());
  const double wave_speed = std::sqrt(law.linearised().pressure_wave_modulus() / scene.material.density);
  std::vector<Vec<D>> X(cloud.X.size());
  for (std::size_t a = 0; a < X.size(); ++a)
    X[a] = cloud.X[a].head<D>();

  const auto assemble = [&]<class Dissipation>(Dissipation dissipation) {
    using ThisBody = Body<D, L, Dissipation>;
    Assembly<ThisBody> assembly{ThisBody(std::move(X), cloud.V, scene.material.density, wave_speed, law,
                                         std::move(graph), std::move(gradient), std::move(dissipation)),
                                Step<ThisBody>(fixed_conditions<D>(scene, cloud),
                                               plane_walls<D>(scene, cloud), scene.momentum_projection),
                                smallest};
    assembly.body.U.p = initial_momenta<D>(scene, cloud);
    return use(assembly);
  };
  if (scene.jst4 == 0)
    return assemble(NoDissipation{});
  return assemble(Jst<D>{build_laplacian<D>(cloud.X, cloud.V, graph, kernel),
                         scene.jst4 * smallest * smallest * smallest});
}

template <class L, class Use>
auto with_dimension(const SceneSpec& scene, const ParticleCloud& cloud, const L& law, Use&& use) {
  return cloud.dimension == 3 ? with_dissipation<3>(scene, cloud, law, use)
                              : with_dissipation<2>(scene, cloud, law, use);
}

/// Memory of the arrays a step touches, bytes a particle.
template <class Body>
double bytes_per_particle(const Body& body) {
  constexpr std::size_t D = Body::dimension;
  constexpr bool jst = decltype(body.dissipation)::active;
  const double an_edge = sizeof(std::int32_t) + 2 * sizeof(Vec<D>) + (jst ? sizeof(double) : 0);
  const double a_particle = sizeof(std::int64_t) + sizeof(double)                       // row, support
                            + sizeof(double) + sizeof(Vec<D>)                           // V, s
                            + 3 * (2 * sizeof(Vec<D>) + sizeof(Mat<D>))                 // U, R and U^n
                            + sizeof(body.history[0]) + sizeof(Mat<D>) + sizeof(Vec<D>) // history, P, T
                            + sizeof(double) + sizeof(Vec<D>)              // stretch, numerical impulse
                            + (jst ? sizeof(double) + sizeof(Vec<D>) : 0); // Laplacian sum, lap p
  return an_edge * body.neighbours.mean() + a_particle;
}

} // namespace tessera::solver
