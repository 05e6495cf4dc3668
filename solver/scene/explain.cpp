#include "solver/scene/explain.hpp"

#include "solver/scene/dissipation.hpp"
#include "solver/scene/make_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace tessera::solver {
namespace {

using Kind = BoundaryCondition::Kind;

std::string dissipation_title(const SceneSpec& scene) {
  const std::string chosen = chosen_dissipation(scene);
  return chosen == "linear_residual" ? "residual dissipation"
         : chosen == "jst"           ? "JST dissipation"
                                     : "symmetric JST dissipation";
}

/// The key that sets its strength.
std::string strength_key(const SceneSpec& scene) {
  return chosen_dissipation(scene) == "linear_residual" ? "residual" : "jst4";
}

class Lists {
 public:
  explicit Lists(Forecast& forecast) : forecast_(forecast) {}

  void place(bool present, const std::string& what, const std::string& why, const std::string& why_not) {
    (present ? forecast_.modelled : forecast_.left_out).push_back({what, present ? why : why_not});
  }

 private:
  Forecast& forecast_;
};

std::string why_J(const SceneSpec& scene, const BodyTraits& body) {
  const double poisson = linearised(scene.material).poisson();
  if (scene.formulation != "auto")
    return fmt::format("solver.formulation = \"{}\"", body.formulation);
  return body.evolves_J
             ? fmt::format(
                   "Poisson's ratio {:.6g}: nearly incompressible, the pressure needs a field of its own",
                   poisson)
             : fmt::format("Poisson's ratio {:.6g} needs none: it does below 0.49", poisson);
}

void list_fields(const SceneSpec& scene, const BodyTraits& body, Lists& lists) {
  const std::string asked = fmt::format("solver.formulation = \"{}\"", body.formulation);
  lists.place(true, fmt::format("{} in {} dimensions", body.title, body.dimension),
              scene.formulation == "auto" ? "formulation \"auto\"" : asked, "");
  lists.place(body.dimension == 3, "the third dimension", "a body in space",
              "plane strain: nothing moves across the plane");
  lists.place(body.evolves_F, "F, the deformation gradient, as a field", "what mixed formulations evolve",
              asked + ": it is taken from the positions");
  lists.place(body.evolves_J, "J, the volume ratio, as a field", why_J(scene, body), why_J(scene, body));
  lists.place(body.evolves_H, "H, the area map, as a field", asked,
              "only solver.formulation = \"pFHJ\" evolves it");
}

void list_numerics(const SceneSpec& scene, const BodyTraits& body, Lists& lists) {
  const std::string dissipation = dissipation_title(scene), key = strength_key(scene);
  lists.place(is_consistent(scene), "balance of constant stresses", "solver.scheme = \"consistent\"",
              "solver.scheme = \"thesis\"");
  lists.place(body.dissipates, dissipation,
              fmt::format("solver.dissipation \"{}\"", chosen_dissipation(scene)),
              scene.jst4 || scene.residual ? fmt::format("solver.{} = 0", key)
                                           : "displacements have none unless it is asked for");
  if (body.blind > 0)
    lists.place(false, fmt::format("{} by {} particles", dissipation, body.blind), "",
                "their neighbours lie on a sphere with them; a wider solver.support");
  if (body.dissipates && chosen_dissipation(scene) == "jst")
    lists.place(scene.jst2 > 0, "JST's shock term", fmt::format("solver.jst2 = {:g}", scene.jst2),
                "solver.jst2 = 0");
  if (body.evolves_J) {
    lists.place(body.dissipates_J, dissipation + " of J",
                fmt::format("solver.{}_J = {:g}", key, body.kappa_J), fmt::format("solver.{}_J = 0", key));
    const double xi = chosen_involution(scene);
    lists.place(xi > 0, "involution penalty", fmt::format("solver.involution = {:g} ties J to det F", xi),
                "solver.involution = 0");
  }
  lists.place(scene.momentum_projection, "momentum projection",
              "inner forces have no resultant and no moment", "solver.momentum_projection = false");
}

void list_conditions(const SceneSpec& scene, Lists& lists) {
  const auto on = [&](std::initializer_list<Kind> kinds) {
    std::string sets;
    for (const BoundaryCondition& c : scene.boundary)
      if (std::find(kinds.begin(), kinds.end(), c.kind) != kinds.end())
        sets += (sets.empty() ? "" : ", ") + (c.on.empty() ? "all" : c.on);
    return sets;
  };
  const auto condition = [&](const std::string& what, std::initializer_list<Kind> kinds) {
    const std::string sets = on(kinds);
    lists.place(!sets.empty(), what, "[[boundary]] on " + sets, "no such [[boundary]]");
  };
  condition("fixed velocities", {Kind::fixed, Kind::sliding, Kind::skew_symmetric});
  condition("moving boundaries", {Kind::velocity});
  condition("surface loads", {Kind::traction, Kind::pressure});
  condition("body forces", {Kind::body_force});
  std::string walls;
  bool friction = false, penalty = false;
  for (const WallSpec& wall : scene.walls) {
    walls += (walls.empty() ? "" : ", ") + wall.name;
    friction = friction || wall.friction > 0;
    penalty = penalty || wall.method == ContactMethod::penalty;
  }
  lists.place(!walls.empty(), "contact with rigid tools", "[[wall]] " + walls, "no [[wall]]");
  if (walls.empty())
    return;
  lists.place(friction, "friction", "[[wall]] friction", "no [[wall]] has any");
  lists.place(penalty, "springs behind walls", "[[wall]] method = \"penalty\"",
              "momenta are limited instead");
}

std::string words(const PlasticRamp& kappa) {
  return kappa.ramped() ? fmt::format("{:.6g}, falling to {:.6g} at a plastic strain of {:.6g}",
                                      kappa.elastic, kappa.plastic, kappa.strain)
                        : fmt::format("{:.6g}", kappa.elastic);
}

/// "auto" or by a key of the case.
std::string chosen_by(const std::string& given, const std::string& key, const std::string& automatic) {
  return given == "auto" ? automatic : fmt::format("solver.{} asks for it", key);
}

Reasoned choice_of_dissipation(const SceneSpec& scene, const BodyTraits& body) {
  const std::string chosen = chosen_dissipation(scene);
  if (!body.dissipates)
    return {"dissipation: none", scene.jst4 || scene.residual
                                     ? fmt::format("solver.{} is 0", strength_key(scene))
                                     : "displacements have none unless it is asked for"};
  std::string what = fmt::format("dissipation: {}, kappa {}", chosen, words(body.kappa));
  if (chosen == "jst" && scene.jst2 > 0)
    what += fmt::format(", kappa2 {:.6g}", scene.jst2);
  if (body.evolves_J)
    what += fmt::format(", of J {:.6g}, involution {:.6g}", body.kappa_J, chosen_involution(scene));
  return {what, chosen_by(scene.dissipation, "dissipation",
                          fmt::format("auto: what the scheme \"{}\" goes with", scene.scheme))};
}

Reasoned choice_of_step(const BodyTraits& body, const Forecast& f) {
  const StepChoice& step = f.step;
  const bool critical = step.bound == "critical";
  const double share = f.dt / (critical ? step.critical : step.by_wave);
  const std::string what = fmt::format("step: {:.4g} s, {:.3g} of the {}", f.dt, share,
                                       critical ? "critical step" : "time of a wave between neighbours");
  // Of dt^2 K + 2 dt C = 4, that of the elastic forces.
  const double elastic = std::pow(step.critical * step.frequency, 2) / 4;
  const std::string spectrum = fmt::format(
      "critical {:.4g} s: the stiffest field swings at {:.4g} rad/s and decays by {:.4g} /s; elastic "
      "forces make {:.0f} % of it, dissipation {:.0f} %",
      step.critical, step.frequency, step.decay, 100 * elastic, 100 * (1 - elastic));
  const std::string wave = fmt::format("wave {:.4g} s: {:.4g} m at {:.6g} m/s", step.by_wave,
                                       body.smallest_distance, body.smallest_distance / step.by_wave);
  return {what, critical ? spectrum + "; " + wave : wave + "; " + spectrum};
}

} // namespace

void explain(const SceneSpec& scene, const ParticleCloud& cloud, const BodyTraits& body, Forecast& forecast) {
  Lists lists(forecast);
  lists.place(true, fmt::format("{} elasticity", scene.material.law), "[material] law", "");
  list_fields(scene, body, lists);
  lists.place(scene.material.plasticity.has_value(), "von Mises plasticity", "[material.plasticity]",
              "no [material.plasticity]");
  list_conditions(scene, lists);
  list_numerics(scene, body, lists);

  const double poisson = linearised(scene.material).poisson();
  const std::string regime = poisson > 0.49 - 1e-9 ? "at least" : "below";
  forecast.choices = {
      {fmt::format("formulation: {}", body.title),
       chosen_by(scene.formulation, "formulation",
                 fmt::format("auto: Poisson's ratio {:.6g} is {} 0.49", poisson, regime))},
      {fmt::format("scheme: {}", scene.scheme),
       is_consistent(scene) ? "constant stresses balance exactly, second order on any cloud"
                            : "corrected kernels, first order on lattices"},
      choice_of_dissipation(scene, body),
      {fmt::format("method: {}", chosen_integrator(scene)),
       chosen_by(scene.integrator, "integrator",
                 fmt::format("auto: what the scheme \"{}\" goes with", scene.scheme))},
      choice_of_step(body, forecast),
      {fmt::format("support: {:.4g} m, {:.1f} neighbours, kernel {}", body.support, forecast.neighbours_mean,
                   scene.kernel),
       scene.support ? fmt::format("solver.support = {:g} spacings", *scene.support)
       : cloud.arrangement == "lattice"
           ? fmt::format("{:g} spacings, usual on lattices", body.support / cloud.spacing)
       : scene.neighbours > 0
           ? fmt::format("largest; each particle's own holds solver.neighbours = {}", scene.neighbours)
           : fmt::format("largest; each particle's own holds the usual {}", body.dimension == 2 ? 14 : 30)},
      {fmt::format("subvolumes: {}", cloud.subvolumes),
       cloud.subvolumes == "voronoi" ? "each particle's exact cell" : "volume over number of particles"}};
}

} // namespace tessera::solver
