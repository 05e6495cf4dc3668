/// From a scene and its cloud to a body, its conditions and its step length.
#pragma once

#include "core/error.hpp"
#include "core/particle_cloud.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/physics/body.hpp"
#include "solver/scene/conditions.hpp"
#include "solver/scene/dissipation.hpp"
#include "solver/scene/graph.hpp"
#include "solver/scene/make_material.hpp"
#include "solver/scene/scene.hpp"
#include "solver/time/heun.hpp"
#include "solver/time/step_limit.hpp"
#include "solver/time/verlet.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace tessera::solver {

/// Everything a run needs, of the types the scene chose.
template <class Body>
struct Assembly {
  Body body;
  std::unique_ptr<Step<Body>> step;
  StepLimit<Body> limit;
};

/// The method a scene asks for.
template <class Body>
std::unique_ptr<Step<Body>> make_step(const SceneSpec& scene, Conditions<Body::dimension> conditions) {
  if (chosen_integrator(scene) == "verlet")
    return std::make_unique<Verlet<Body>>(std::move(conditions), scene.momentum_projection);
  return std::make_unique<Heun<Body>>(std::move(conditions), scene.momentum_projection);
}

/// Verlet's step is a share of the critical one. Heun's goes by (3.93); strong dissipation of close particles
/// may ask for less, so a share of the critical step bounds it too.
template <class Body>
StepLimit<Body> make_limit(const SceneSpec& scene, double smallest) {
  constexpr double none = std::numeric_limits<double>::infinity(), enough = 0.8;
  if (chosen_integrator(scene) == "verlet")
    return {smallest, none, chosen_cfl(scene)};
  return {smallest, chosen_cfl(scene), Body::dissipates ? enough : 0};
}

inline StepChoice step_choice(const StepBounds& bounds) {
  return {bounds.by_wave, bounds.critical, bounds.critical_binds ? "critical" : "wave", bounds.frequency,
          bounds.decay};
}

/// Calls use(assembly): a body is built where it stays.
template <class Formulation, class Dissipation, class Use>
auto assemble(const SceneSpec& scene, const ParticleCloud& cloud, Use&& use) {
  constexpr int D = Formulation::dimension;
  Neighbours graph = build_graph<D>(scene, cloud);
  const Kernel<D> kernel{kernel_named(scene.kernel)};
  const std::vector<double> nearest = distance_to_nearest(cloud.X, 1, cloud.hidden);
  const double smallest = *std::min_element(nearest.begin(), nearest.end());
  auto material = make_material<D>(scene.material, cloud.size());

  const double modulus = material->linearised().pressure_wave_modulus();
  Dissipation dissipation{};
  set_up<Formulation, D>(dissipation, {scene, cloud, graph, kernel, smallest, modulus});
  Gradient<D> gradient = build_gradient<D>(cloud.X, cloud.V, graph, kernel);
  if (is_consistent(scene))
    balance_constant_stress<D>(gradient, cloud.X, cloud.A, graph);

  std::vector<Vec<D>> X(cloud.X.size());
  for (std::size_t a = 0; a < X.size(); ++a)
    X[a] = cloud.X[a].head<D>();
  using ThisBody = Body<Formulation, Dissipation>;
  Assembly<ThisBody> assembly{ThisBody({std::move(X), scene.material.density, std::move(material),
                                        std::move(graph), std::move(gradient), std::move(dissipation),
                                        Formulation::evolves_J ? chosen_involution(scene) : 0, smallest}),
                              make_step<ThisBody>(scene, make_conditions<D>(scene, cloud, modulus, smallest)),
                              make_limit<ThisBody>(scene, smallest)};
  set_initial(scene, cloud, assembly.body);
  return use(assembly);
}

/// Calls use(assembly) with the dissipation the scene asks for.
template <class Formulation, class Use>
auto with_assembly(const SceneSpec& scene, const ParticleCloud& cloud, Use&& use) {
  return with_dissipation<Formulation>(
      scene, [&]<class Dissipation>() { return assemble<Formulation, Dissipation>(scene, cloud, use); });
}

/// What decides the memory of a body beside the types it is made of.
struct MemoryNeeds {
  double neighbours = 0;         ///< mean
  std::size_t history_bytes = 0; ///< a particle, of the material
  double outside_bytes = 0;      ///< a particle, of walls, loads and held velocities
  bool shocks = false;           ///< the dissipation has a shock term
};

/// Memory of the arrays a step touches, bytes a particle.
template <class Formulation, class Dissipation>
double bytes_per_particle(const MemoryNeeds& needs) {
  constexpr std::size_t D = Formulation::dimension;
  constexpr std::size_t vector = sizeof(Vec<D>), tensor = sizeof(Mat<D>), number = sizeof(double);
  constexpr std::size_t state = 2 * vector + Formulation::evolves_F * tensor +
                                Formulation::evolves_H * sizeof(Mat3) + Formulation::evolves_J * number;
  constexpr double an_edge = sizeof(std::int32_t) + sizeof(float) + Dissipation::edge_bytes;
  constexpr std::size_t a_particle = sizeof(std::int64_t) + number               // row, support
                                     + sizeof(Lanes<D, 2>) + 2 * tensor + number // gradient
                                     + 2 * state                                 // U and U^n
                                     + Formulation::evolves_J * number           // numerical changes of J
                                     + Formulation::evolves_H * sizeof(Mat3)     // and H
                                     + !Formulation::evolves_F * tensor          // grad x
                                     + sizeof(typename Dissipation::Field)       // sent
                                     + sizeof(Lanes<D, 2 * D>)                   // pull
                                     + 2 * vector + number + vector              // R, T, wave, impulse
                                     + number + vector // of the critical step: stiffness, field
                                     + Dissipation::of_J * 2 * number + Dissipation::particle_bytes;
  return an_edge * needs.neighbours +
         static_cast<double>(a_particle + needs.history_bytes +
                             (needs.shocks ? Dissipation::sensor_bytes : 0)) +
         needs.outside_bytes;
}

template <class Body>
MemoryNeeds memory_needs(const SceneSpec& scene, const Assembly<Body>& assembly) {
  return {assembly.body.neighbours.mean(), assembly.body.material->history_bytes(),
          static_cast<double>(assembly.step->outside_bytes()) +
              static_cast<double>(assembly.step->held().bytes()) / static_cast<double>(assembly.body.size()),
          scene.jst2 > 0};
}

template <class Body>
double bytes_of(const SceneSpec& scene, const Assembly<Body>& assembly) {
  return bytes_per_particle<typename Body::Formulation, decltype(assembly.body.dissipation)>(
      memory_needs(scene, assembly));
}

} // namespace tessera::solver
