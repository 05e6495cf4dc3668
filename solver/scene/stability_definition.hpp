/// Body of stability_formulation, for the one source file of each formulation that instantiates it.
#pragma once

#include "solver/scene/assemble.hpp"
#include "solver/scene/run_formulation.hpp"
#include "solver/scene/stability.hpp"
#include "solver/time/linearisation.hpp"
#include "solver/time/spectrum.hpp"

#include <algorithm>

namespace tessera::solver {

/// F = diag(stretch) everywhere, no momenta.
template <class Body>
void stretch_evenly(Body& body, const ParticleCloud& cloud, const Vec3& stretch) {
  constexpr int D = Body::dimension;
  std::vector<Vec<D>> x(body.V.size());
  for (std::size_t a = 0; a < x.size(); ++a)
    x[a] = cloud.X[a].cwiseProduct(stretch).template head<D>();
  const Mat<D> F = stretch.head<D>().asDiagonal();
  body.deform(std::move(x), std::vector<Mat<D>>(body.V.size(), F));
  body.commit();
}

template <class Formulation>
StabilityFindings stability_formulation(const SceneSpec& scene, const ParticleCloud& cloud,
                                        const Vec3& stretch) {
  constexpr int D = Formulation::dimension;
  return with_assembly<Formulation>(scene, cloud, [&](auto& assembly) {
    auto& body = assembly.body;
    using ThisBody = std::remove_reference_t<decltype(body)>;
    stretch_evenly(body, cloud, stretch);
    StabilityFindings findings;
    findings.formulation = Formulation::name;
    findings.scheme = scene.scheme;
    findings.dissipation = ThisBody::dissipates ? chosen_dissipation(scene) : "none";
    findings.integrator = chosen_integrator(scene);
    findings.particles = body.size();
    findings.neighbours_mean = body.neighbours.mean();
    findings.dt = assembly.limit(body);
    const StepBounds bounds = assembly.limit.bounds(body);
    findings.step = step_choice(bounds);
    findings.unknowns = (2 * D + Formulation::evolves_J) * body.size();
    if (findings.unknowns <= largest_matrix) {
      const std::vector<double> nearest = distance_to_nearest(cloud.X, 1, cloud.hidden);
      const double smallest = *std::min_element(nearest.begin(), nearest.end());
      const double modulus = body.material->linearised().pressure_wave_modulus();
      const Conditions<D> conditions = make_conditions<D>(scene, cloud, modulus, smallest);
      findings.spectrum =
          spectrum_of(Linearisation<ThisBody>(body, conditions.held, scene.momentum_projection, smallest)(),
                      findings.integrator);
    }
    return findings;
  });
}

} // namespace tessera::solver
