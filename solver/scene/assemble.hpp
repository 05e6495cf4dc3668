/// From a scene and its cloud to a body, its conditions and its step length.
#pragma once

#include "core/error.hpp"
#include "core/particle_cloud.hpp"
#include "solver/operators/laplacian.hpp"
#include "solver/physics/body.hpp"
#include "solver/scene/conditions.hpp"
#include "solver/scene/graph.hpp"
#include "solver/scene/make_material.hpp"
#include "solver/scene/scene.hpp"
#include "solver/time/step.hpp"

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

/// kappa4 of the momentum: with displacements, the baseline, there is none unless asked for.
template <class Formulation>
Kappa4 chosen_kappa4(const SceneSpec& scene) {
  return scene.jst4.value_or(Kappa4::constant(Formulation::evolves_F ? 1.0 / 8 : 0.0));
}

inline double chosen_kappa4_J(const SceneSpec& scene) {
  return scene.jst4_J.value_or(scene.jst4.value_or(Kappa4{}).elastic);
}

/// On a cloud with a boundary lap lap of J is not symmetric and feeds some fields at up to 1.5 kappa4
/// c/Delta: from 3.2 kappa4 on the penalty held in every run tried (docs/validation.md).
inline double chosen_involution(const SceneSpec& scene) {
  return scene.involution.value_or(4 * chosen_kappa4_J(scene));
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

  Dissipation dissipation{};
  if constexpr (Dissipation::active) {
    dissipation.laplacian = build_laplacian<D>(cloud.X, cloud.V, graph, kernel);
    dissipation.delta = smallest;
    dissipation.kappa4 = chosen_kappa4<Formulation>(scene);
    dissipation.kappa2 = scene.jst2;
    // A shock of a strain below this is none.
    dissipation.pressure_floor = 1e-4 * material->linearised().pressure_wave_modulus();
    if constexpr (Dissipation::of_J)
      dissipation.kappa4_J = chosen_kappa4_J(scene);
  }

  std::vector<Vec<D>> X(cloud.X.size());
  for (std::size_t a = 0; a < X.size(); ++a)
    X[a] = cloud.X[a].head<D>();
  Gradient<D> gradient = build_gradient<D>(cloud.X, cloud.V, graph, kernel);
  const double modulus = material->linearised().pressure_wave_modulus();
  using ThisBody = Body<Formulation, Dissipation>;
  Assembly<ThisBody> assembly{
      ThisBody({std::move(X), cloud.V, scene.material.density, std::move(material), std::move(graph),
                std::move(gradient), std::move(dissipation),
                Formulation::evolves_J ? chosen_involution(scene) : 0, smallest}),
      Step<ThisBody>(make_conditions<D>(scene, cloud, modulus, smallest), scene.momentum_projection),
      smallest};
  set_initial(scene, cloud, assembly.body);
  return use(assembly);
}

/// Calls use(assembly) with the dissipation the scene asks for.
template <class Formulation, class Use>
auto with_assembly(const SceneSpec& scene, const ParticleCloud& cloud, Use&& use) {
  constexpr int D = Formulation::dimension;
  const Kappa4 kappa4 = chosen_kappa4<Formulation>(scene);
  const bool of_p = kappa4.elastic > 0 || kappa4.plastic > 0 || scene.jst2 > 0;
  if constexpr (Formulation::evolves_J) {
    if (of_p && (chosen_kappa4_J(scene) > 0 || scene.jst2 > 0))
      return assemble<Formulation, JstWithJ<D>>(scene, cloud, use);
  }
  return of_p ? assemble<Formulation, Jst<D>>(scene, cloud, use)
              : assemble<Formulation, NoDissipation>(scene, cloud, use);
}

/// Memory of the arrays a step touches, bytes a particle.
template <class Formulation, class Dissipation>
double bytes_per_particle(double neighbours, std::size_t history_bytes, bool external) {
  constexpr std::size_t D = Formulation::dimension;
  constexpr std::size_t vector = sizeof(Vec<D>), tensor = sizeof(Mat<D>), number = sizeof(double);
  constexpr bool jst = Dissipation::active, jst_J = Dissipation::of_J;
  constexpr std::size_t state = 2 * vector + Formulation::evolves_F * tensor +
                                Formulation::evolves_H * sizeof(Mat3) + Formulation::evolves_J * number;
  const double an_edge = sizeof(std::int32_t) + 2 * vector + jst * number;
  const double a_particle = sizeof(std::int64_t) + number        // row, support
                            + number + vector                    // V, s
                            + 3 * state                          // U, R and U^n
                            + !Formulation::evolves_F * tensor   // grad x
                            + static_cast<double>(history_bytes) //
                            + tensor + vector                    // P, T
                            + number + vector                    // wave, numerical impulse
                            + (external ? vector : 0)            // impulse from outside
                            + jst * (2 * number + vector)        // Laplacian sum, epsilon4, lap p
                            + jst_J * 2 * number;                // lap J, D^J
  return an_edge * neighbours + a_particle;
}

template <class Body>
double bytes_of(const Assembly<Body>& assembly) {
  const Body& body = assembly.body;
  return bytes_per_particle<typename Body::Formulation, decltype(body.dissipation)>(
      body.neighbours.mean(), body.material->history_bytes(), assembly.step.works());
}

} // namespace tessera::solver
