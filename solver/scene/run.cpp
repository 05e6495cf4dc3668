#include "solver/physics/materials/hencky.hpp"
#include "solver/physics/materials/linear_elastic.hpp"
#include "solver/physics/materials/mooney_rivlin.hpp"
#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/materials/ogden.hpp"
#include "solver/physics/materials/saint_venant_kirchhoff.hpp"
#include "solver/physics/plasticity/hardening.hpp"
#include "solver/physics/plasticity/von_mises.hpp"
#include "solver/scene/run_law.hpp"
#include "solver/scene/scene.hpp"

namespace tessera::solver {
namespace {

/// Calls use(law) with the law of a validated material.
template <class Use>
auto with_law(const MaterialSpec& material, Use&& use) {
  if (material.law == "mooney_rivlin")
    return use(MooneyRivlin{material.c1, material.c2, material.bulk});
  if (material.law == "ogden") {
    Ogden ogden{{}, material.bulk};
    for (std::size_t p = 0; p < material.mu.size(); ++p)
      ogden.terms.push_back({material.mu[p], material.alpha[p]});
    return use(ogden);
  }
  const ElasticConstants elastic = ElasticConstants::from(material.young, material.poisson);
  if (material.law == "linear_elastic")
    return use(LinearElastic{elastic});
  if (material.law == "saint_venant_kirchhoff")
    return use(SaintVenantKirchhoff{elastic});
  if (material.law == "neo_hookean")
    return use(NeoHookean{elastic});
  const Hencky hencky{elastic};
  if (!material.plasticity)
    return use(hencky);
  return std::visit(
      [&](const auto& hardening) {
        return use(VonMises{hencky, hardening});
      },
      *material.plasticity);
}

} // namespace

Summary run(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs, Progress& progress) {
  cloud.validate("");
  return with_law(scene.material,
                  [&](const auto& law) { return run_law(law, scene, cloud, outputs, progress); });
}

Forecast forecast(const SceneSpec& scene, const ParticleCloud& cloud) {
  cloud.validate("");
  return with_law(scene.material, [&](const auto& law) { return forecast_law(law, scene, cloud); });
}

} // namespace tessera::solver
