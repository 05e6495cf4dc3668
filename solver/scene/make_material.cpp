#include "solver/scene/make_material.hpp"

#include "solver/physics/materials/hencky.hpp"
#include "solver/physics/materials/linear_elastic.hpp"
#include "solver/physics/materials/mooney_rivlin.hpp"
#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/materials/ogden.hpp"
#include "solver/physics/materials/saint_venant_kirchhoff.hpp"
#include "solver/physics/plasticity/hardening.hpp"
#include "solver/physics/plasticity/von_mises.hpp"

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

template <int D>
std::unique_ptr<Material<D>> make_material(const MaterialSpec& spec, std::int64_t particles) {
  return with_law(spec, [&]<class Law>(const Law& law) -> std::unique_ptr<Material<D>> {
    return std::make_unique<MaterialOf<D, Law>>(law, particles);
  });
}

template std::unique_ptr<Material<2>> make_material<2>(const MaterialSpec&, std::int64_t);
template std::unique_ptr<Material<3>> make_material<3>(const MaterialSpec&, std::int64_t);

ElasticConstants linearised(const MaterialSpec& spec) {
  return with_law(spec, [](const auto& law) { return law.linearised(); });
}

} // namespace tessera::solver
