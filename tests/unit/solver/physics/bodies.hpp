/// Bodies put together by hand.
#pragma once

#include "solver/operators/support.hpp"
#include "solver/physics/body.hpp"
#include "solver/physics/jst.hpp"
#include "solver/physics/jst_symmetric.hpp"
#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/residual_dissipation.hpp"
#include "tests/support/clouds.hpp"

#include <functional>
#include <type_traits>

namespace tessera::solver {

/// A neo-Hookean body (E = 17 MPa, nu = 0.45, 1100 kg/m^3) of a cloud; `prepare` may change its parts.
template <class Formulation, class Dissipation>
Body<Formulation, Dissipation>
make_body(const ParticleCloud& cloud, Dissipation dissipation,
          const std::type_identity_t<std::function<void(BodyParts<Formulation::dimension, Dissipation>&)>>&
              prepare = {}) {
  constexpr int D = Formulation::dimension;
  Neighbours graph = uniform_support(cloud.X, 2.2 * cloud.spacing);
  std::vector<Vec<D>> X;
  for (const Vec3& x : cloud.X)
    X.push_back(x.head<D>());
  if constexpr (requires { dissipation.weigh(cloud.X, cloud.V, graph); })
    dissipation.weigh(cloud.X, cloud.V, graph);
  else if constexpr (requires { dissipation.weigh(cloud.V); })
    dissipation.weigh(cloud.V);
  else if constexpr (requires { dissipation.laplacian; })
    dissipation.laplacian = build_laplacian<D>(cloud.X, cloud.V, graph);
  const NeoHookean law{ElasticConstants::from(17e6, 0.45)};
  Gradient<D> gradient = build_gradient<D>(cloud.X, cloud.V, graph);
  BodyParts<D, Dissipation> parts{std::move(X),
                                  1100,
                                  std::make_unique<MaterialOf<D, NeoHookean>>(law, cloud.size()),
                                  std::move(graph),
                                  std::move(gradient),
                                  std::move(dissipation)};
  if (prepare)
    prepare(parts);
  return Body<Formulation, Dissipation>(std::move(parts));
}

/// A smooth large deformation, and a smooth field of momenta.
inline Vec3 deformed(const Vec3& X) {
  return {1.3 * X[0] + 0.2 * X[1] * X[1], 0.9 * X[1] + 0.3 * std::sin(X[0]), 1.05 * X[2] + 0.1 * X[0] * X[1]};
}
inline Vec3 stirred(const Vec3& X) {
  return {300 * std::cos(2 * X[1]), 200 * X[0] * X[2], -400 * std::sin(X[0] + X[1])};
}

template <class Body>
void deform_and_stir(Body& body, const ParticleCloud& cloud) {
  constexpr int D = Body::dimension;
  std::vector<Vec<D>> x;
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    x.push_back(deformed(cloud.X[a]).template head<D>());
    body.U.p[a] = stirred(cloud.X[a]).template head<D>();
  }
  body.deform(std::move(x));
  body.commit();
}

} // namespace tessera::solver
