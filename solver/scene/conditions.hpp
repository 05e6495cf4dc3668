/// From a scene's entries and a cloud's sets to the conditions a step knows, and the state it begins with.
#pragma once

#include "core/error.hpp"
#include "core/particle_cloud.hpp"
#include "solver/scene/scene.hpp"
#include "solver/time/step.hpp"

#include <fmt/format.h>

#include <vector>

namespace tessera::solver {

/// For a body of this pressure wave modulus (Pa) and smallest particle distance (m). Throws InputError where
/// a set has no surface to slide on or to load, or the body begins behind a wall.
template <int D>
Conditions<D> make_conditions(const SceneSpec& scene, const ParticleCloud& cloud, double modulus,
                              double smallest);

/// Initial momenta, kg/(m^2 s).
template <int D>
std::vector<Vec<D>> initial_momenta(const SceneSpec& scene, const ParticleCloud& cloud);

/// Initial positions, m; empty where the scene displaces nothing.
template <int D>
std::vector<Vec<D>> initial_positions(const SceneSpec& scene, const ParticleCloud& cloud);

/// Deformation gradients of the formula that displaces the whole body. Empty where none does, where a set of
/// particles is then displaced on its own (no formula knows the step between them), where the formula has no
/// slope, and with the thesis' scheme, whose figures begin with the gradient of the particles' positions.
template <int D>
std::vector<Mat<D>> initial_gradients(const SceneSpec& scene, const ParticleCloud& cloud);

/// Gives a body at rest the state its scene begins with. InputError where that turns it inside out.
template <class Body>
void set_initial(const SceneSpec& scene, const ParticleCloud& cloud, Body& body) {
  constexpr int D = Body::dimension;
  body.U.p = initial_momenta<D>(scene, cloud);
  if (std::vector<Vec<D>> x = initial_positions<D>(scene, cloud); !x.empty()) {
    body.deform(std::move(x), initial_gradients<D>(scene, cloud));
    try {
      body.commit();
    } catch (const Breakdown& breakdown) {
      const Vec3 X = cloud.X[static_cast<std::size_t>(breakdown.particle)];
      throw InputError(
          fmt::format(
              "the initial displacement makes the volume ratio J {:.3g} at ({:.4g}, {:.4g}, {:.4g}) m",
              breakdown.J, X[0], X[1], X[2]),
          "[[initial]] displacement", "displace the body so that it is nowhere turned inside out");
    }
  }
}

} // namespace tessera::solver
