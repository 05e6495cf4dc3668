#include "solver/physics/residual_dissipation.hpp"

#include "solver/operators/consistent.hpp"
#include "tests/unit/solver/physics/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

template <class T>
class Residual : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Residual, Dimensions);

template <int D>
ParticleCloud irregular_block() {
  return test::jittered(D == 3 ? test::box_lattice(6, 7, 6, Vec3(0.5, 0.6, 0.5))
                               : test::box_lattice(9, 11, 1, Vec3(0.8, 1, 0)),
                        0.3, 9);
}

template <int D>
ResidualDissipation<D> residual(double kappa) {
  ResidualDissipation<D> dissipation;
  dissipation.kappa = PlasticRamp::constant(kappa);
  return dissipation;
}

double number(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

/// D_a of the last rates, N/m^3.
template <class Body>
auto dissipated(const Body& body) {
  auto rates = body.R.p;
  for (std::size_t a = 0; a < rates.size(); ++a)
    rates[a] -= body.T[a];
  return rates;
}

template <class Body>
void stir(Body& body, std::mt19937_64& random) {
  for (auto& p : body.U.p)
    for (double& component : p)
      component = 1000 * number(random);
}

} // namespace

TYPED_TEST(Residual, SparesLinearMomentaAndRotations) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  auto body = make_body<PF<D>>(cloud, residual<D>(2));
  std::mt19937_64 random(3);
  Mat<D> any, spin;
  for (double& component : any.reshaped())
    component = 1e4 * number(random);
  spin = any - any.transpose();
  double rough = 0;
  stir(body, random);
  body.rates();
  for (const auto& force : dissipated(body))
    rough = std::max(rough, force.norm());
  for (const Mat<D>& slope : {any, spin}) {
    for (std::size_t a = 0; a < cloud.X.size(); ++a)
      body.U.p[a] = Vec<D>::Constant(7) + slope * cloud.X[a].head<D>();
    body.rates();
    for (const auto& force : dissipated(body))
      EXPECT_LT(force.norm(), 1e-11 * rough);
  }
}

TYPED_TEST(Residual, ConservesMomentumAndOnlyTakesEnergy) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  auto body = make_body<PF<D>>(cloud, residual<D>(1), [&](auto& parts) {
    balance_constant_stress<D>(parts.gradient, cloud.X, cloud.A, parts.neighbours);
  });
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    stir(body, random);
    // Waves of different speeds in different places.
    for (double& c : body.wave)
      c = 100 * (2 + number(random));
    body.dissipation.advance(body);
    body.rates();
    const auto force = dissipated(body);
    Vec<D> total = Vec<D>::Zero();
    double power = 0, scale = 0;
    for (std::size_t a = 0; a < force.size(); ++a) {
      total += body.V[a] * force[a];
      power += body.V[a] * force[a].dot(body.U.p[a]);
      scale += body.V[a] * force[a].norm();
    }
    EXPECT_LT(total.norm(), 1e-13 * scale);
    EXPECT_LT(power, -0.1 * scale); // random momenta are rough ones
  }
}

TYPED_TEST(Residual, IsAntisymmetricInPairs) {
  // A particle that alone moves, with the slopes around it: what each neighbour gets from it, it loses.
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  auto body = make_body<PF<D>>(cloud, residual<D>(1));
  std::mt19937_64 random(6);
  stir(body, random);
  body.rates();
  const auto& dissipation = body.dissipation;
  const auto& graph = body.neighbours;
  const auto given_to = [&](std::int64_t a, std::int64_t e) { // D_a V_a from the neighbour of edge e alone
    const std::int32_t b = graph.column[e];
    const auto reach = body.gradient.reach(a, e, b);
    typename ResidualDissipation<D>::Second sum;
    dissipation.add_second(sum, a, e, b, body.sent[b] - body.sent[a], body.gradient.omega[e], reach);
    return Vec<D>(body.V[a] * dissipation.end_second(sum, reach, body, a).template head<D>());
  };
  for (std::int64_t a = 0; a < body.size(); ++a)
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      const std::int32_t b = graph.column[e];
      std::int64_t back = graph.row[b];
      while (graph.column[back] != a)
        ++back;
      const Vec<D> to_a = given_to(a, e), to_b = given_to(b, back);
      ASSERT_LT((to_a + to_b).norm(), 1e-12 * to_a.norm()) << a << ' ' << b;
    }
}

TYPED_TEST(Residual, OfTheVolumeMapKeepsItsSum) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  ResidualDissipation<D, true> dissipation;
  dissipation.kappa_J = 1;
  auto body = make_body<PFJ<D>>(cloud, dissipation);
  std::mt19937_64 random(8);
  for (double& J : body.U.J)
    J = 1 + 0.1 * number(random);
  body.rates(); // at rest: all of dJ/dt is dissipation
  double total = 0, scale = 0, power = 0;
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    total += body.V[a] * body.R.J[a];
    scale += body.V[a] * std::abs(body.R.J[a]);
    power += body.V[a] * body.R.J[a] * body.U.J[a];
  }
  EXPECT_GT(scale, 0);
  EXPECT_LT(std::abs(total), 1e-13 * scale);
  EXPECT_LT(power, 0);
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    body.U.J[a] = 1 + 0.1 * cloud.X[a][0] - 0.2 * cloud.X[a][1];
  body.rates();
  for (const double rate : body.R.J)
    EXPECT_LT(std::abs(rate), 1e-12 * scale / cloud.domain_volume);
}

TYPED_TEST(Residual, DisplacementsBearItToo) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  auto plain = make_body<Displacement<D>>(cloud, residual<D>(1));
  auto mixed = make_body<PF<D>>(cloud, residual<D>(1));
  std::mt19937_64 random(2), again(2);
  stir(plain, random);
  stir(mixed, again);
  plain.rates();
  mixed.rates();
  const auto one = dissipated(plain), other = dissipated(mixed);
  for (std::size_t a = 0; a < one.size(); ++a)
    EXPECT_LT((one[a] - other[a]).norm(), 1e-13 * one[a].norm()) << a;
}
