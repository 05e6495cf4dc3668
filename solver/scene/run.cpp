#include "solver/physics/formulation.hpp"
#include "solver/scene/make_material.hpp"
#include "solver/scene/run_formulation.hpp"
#include "solver/scene/scene.hpp"

namespace tessera::solver {
namespace {

/// Calls use.operator()<Formulation>() with the formulation of a validated scene.
template <int D, class Use>
auto with_formulation(const std::string& name, Use&& use) {
  if (name == Displacement<D>::name)
    return use.template operator()<Displacement<D>>();
  if (name == PFJ<D>::name)
    return use.template operator()<PFJ<D>>();
  if (name == PFHJ<D>::name)
    return use.template operator()<PFHJ<D>>();
  return use.template operator()<PF<D>>();
}

template <class Use>
auto with_formulation(const SceneSpec& scene, const ParticleCloud& cloud, Use&& use) {
  cloud.validate("");
  const std::string name = chosen_formulation(scene);
  return cloud.dimension == 3 ? with_formulation<3>(name, use) : with_formulation<2>(name, use);
}

} // namespace

std::string chosen_formulation(const SceneSpec& scene) {
  if (scene.formulation != "auto")
    return scene.formulation;
  constexpr double nearly_incompressible = 0.49;
  // Poisson's ratio as written may miss 0.49 by a rounding once it has been moduli.
  return linearised(scene.material).poisson() > nearly_incompressible - 1e-9 ? PFJ<3>::name : PF<3>::name;
}

std::string chosen_integrator(const SceneSpec& scene) {
  if (scene.integrator != "auto")
    return scene.integrator;
  return scene.scheme == "thesis" ? "heun" : "verlet";
}

double chosen_cfl(const SceneSpec& scene) {
  constexpr double heun = 0.3, verlet = 0.8;
  return scene.cfl.value_or(chosen_integrator(scene) == "heun" ? heun : verlet);
}

std::string chosen_dissipation(const SceneSpec& scene) {
  if (scene.dissipation != "auto")
    return scene.dissipation;
  return scene.scheme == "consistent" ? "linear_residual" : "jst";
}

Summary run(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs, Progress& progress) {
  return with_formulation(scene, cloud, [&]<class Formulation>() {
    return run_formulation<Formulation>(scene, cloud, outputs, progress);
  });
}

Forecast forecast(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs) {
  return with_formulation(scene, cloud, [&]<class Formulation>() {
    return forecast_formulation<Formulation>(scene, cloud, outputs);
  });
}

StabilityFindings stability(const SceneSpec& scene, const ParticleCloud& cloud, const Vec3& stretch) {
  SceneSpec held = scene;
  held.initial.clear();
  held.walls.clear();
  using Kind = BoundaryCondition::Kind;
  std::erase_if(held.boundary, [](const BoundaryCondition& condition) {
    return condition.kind == Kind::traction || condition.kind == Kind::pressure ||
           condition.kind == Kind::body_force;
  });
  return with_formulation(held, cloud, [&]<class Formulation>() {
    return stability_formulation<Formulation>(held, cloud, stretch);
  });
}

} // namespace tessera::solver
