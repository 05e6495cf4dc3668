/// The dissipation a scene asks for.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/operators/laplacian.hpp"
#include "solver/physics/jst.hpp"
#include "solver/physics/jst_symmetric.hpp"
#include "solver/physics/residual_dissipation.hpp"
#include "solver/scene/scene.hpp"

#include <string>

namespace tessera::solver {

inline bool is_consistent(const SceneSpec& scene) {
  return scene.scheme == "consistent";
}

/// kappa4 of the momentum: with displacements, the baseline, there is none unless asked for.
template <class Formulation>
PlasticRamp chosen_kappa4(const SceneSpec& scene) {
  return scene.jst4.value_or(PlasticRamp::constant(Formulation::evolves_F ? 1.0 / 8 : 0.0));
}

inline double chosen_kappa4_J(const SceneSpec& scene) {
  return scene.jst4_J.value_or(scene.jst4.value_or(PlasticRamp{}).elastic);
}

/// kappa of the residual dissipation, by the same rule.
template <class Formulation>
PlasticRamp chosen_residual(const SceneSpec& scene) {
  if (!Formulation::evolves_F)
    return scene.residual.value_or(PlasticRamp::constant(0));
  return scene.residual.value_or(scene.material.plasticity ? usual_plastic_residual
                                                           : PlasticRamp::constant(usual_residual));
}

inline double chosen_residual_J(const SceneSpec& scene) {
  return scene.residual_J.value_or(usual_residual_J);
}

/// From 3.2 kappa4 on (jst), 2.4 kappa4 (jst_symmetric) and 0.2 (linear_residual) the penalty held in every
/// run tried (docs/validation.md, docs/theory.md).
inline double chosen_involution(const SceneSpec& scene) {
  const std::string dissipation = chosen_dissipation(scene);
  const double enough = dissipation == "linear_residual" ? 0.2
                        : dissipation == "jst"           ? 4 * chosen_kappa4_J(scene)
                                                         : 3 * chosen_kappa4_J(scene);
  return scene.involution.value_or(enough);
}

/// What a dissipation is made from.
template <int D>
struct DissipationGround {
  const SceneSpec& scene;
  const ParticleCloud& cloud;
  const Neighbours& neighbours;
  const Kernel<D>& kernel;
  double smallest_distance; ///< m
  double modulus;           ///< of pressure waves, Pa
};

template <class Formulation, int D>
void set_up(NoDissipation<D>&, const DissipationGround<D>&) {}

template <class Formulation, int D, bool with_J>
void set_up(Jst<D, with_J>& jst, const DissipationGround<D>& on) {
  jst.laplacian = build_laplacian<D>(on.cloud.X, on.cloud.V, on.neighbours, on.kernel);
  jst.delta = on.smallest_distance;
  jst.kappa4 = chosen_kappa4<Formulation>(on.scene);
  jst.kappa4_J = chosen_kappa4_J(on.scene);
  jst.kappa2 = on.scene.jst2;
  jst.pressure_floor = 1e-4 * on.modulus; // a shock of a strain below this is none
}

template <class Formulation, int D, bool with_J>
void set_up(JstSymmetric<D, with_J>& jst, const DissipationGround<D>& on) {
  jst.weigh(on.cloud.X, on.cloud.V, on.neighbours, on.kernel);
  jst.kappa4 = chosen_kappa4<Formulation>(on.scene);
  jst.kappa4_J = chosen_kappa4_J(on.scene);
}

template <class Formulation, int D, bool with_J>
void set_up(ResidualDissipation<D, with_J>& residual, const DissipationGround<D>& on) {
  residual.weigh(on.cloud.V);
  residual.kappa = chosen_residual<Formulation>(on.scene);
  residual.kappa_J = chosen_residual_J(on.scene);
}

/// Calls use.operator()<Dissipation>() with the one the scene asks for.
template <class Formulation, class Use>
auto with_dissipation(const SceneSpec& scene, Use&& use) {
  constexpr int D = Formulation::dimension;
  const auto choose = [&]<class OfP, class WithJ>(bool of_p, bool of_J) {
    if constexpr (Formulation::evolves_J) {
      if (of_p && of_J)
        return use.template operator()<WithJ>();
    }
    return of_p ? use.template operator()<OfP>() : use.template operator()<NoDissipation<D>>();
  };
  const std::string name = chosen_dissipation(scene);
  if (name == "linear_residual")
    return choose.template operator()<ResidualDissipation<D>, ResidualDissipation<D, true>>(
        chosen_residual<Formulation>(scene).any(), chosen_residual_J(scene) > 0);
  const bool fourth = chosen_kappa4<Formulation>(scene).any(), fourth_J = chosen_kappa4_J(scene) > 0;
  if (name == "jst_symmetric")
    return choose.template operator()<JstSymmetric<D>, JstSymmetric<D, true>>(fourth, fourth_J);
  const bool second = scene.jst2 > 0;
  return choose.template operator()<Jst<D>, Jst<D, true>>(fourth || second, fourth_J || second);
}

} // namespace tessera::solver
