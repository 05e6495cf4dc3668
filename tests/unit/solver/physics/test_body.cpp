/// What the formulations share and where they differ.

#include "tests/unit/solver/physics/bodies.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

template <int D>
ParticleCloud block() {
  return D == 3 ? test::box_lattice(5, 6, 5, Vec3(0.8, 1, 0.8)) : test::box_lattice(7, 9, 1, Vec3(0.8, 1, 0));
}

template <class Formulation>
auto stirred_body() {
  const ParticleCloud cloud = block<Formulation::dimension>();
  auto body = make_body<Formulation>(cloud, NoDissipation<Formulation::dimension>{});
  deform_and_stir(body, cloud);
  return body;
}

template <class T>
class EveryDimension : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(EveryDimension, Dimensions);

/// Largest difference of two bodies' stresses over the largest stress.
template <class Body, class Other>
double distance(const Body& body, const Other& other) {
  double worst = 0, scale = 0;
  for (std::int64_t a = 0; a < body.size(); ++a) {
    worst = std::max(worst, (body.P(a) - other.P(a)).norm());
    scale = std::max(scale, body.P(a).norm());
  }
  return worst / scale;
}

/// dF/dt of every particle.
template <class Body>
auto velocity_gradients(Body& body) {
  std::vector<Mat<Body::dimension>> G(body.V.size());
  body.sweep_momenta(body.U, [&](std::int64_t a, const Mat<Body::dimension>& G_a) { G[a] = G_a; });
  return G;
}

template <int D>
Jst<D> jst(double kappa4, double kappa2 = 0) {
  Jst<D> dissipation;
  dissipation.delta = 0.1;
  dissipation.kappa4 = Kappa4::constant(kappa4);
  dissipation.kappa2 = kappa2;
  dissipation.pressure_floor = 1e3;
  return dissipation;
}

} // namespace

TYPED_TEST(EveryDimension, FormulationsStartFromTheSameStress) {
  constexpr int D = TypeParam::value;
  const auto pF = stirred_body<PF<D>>();
  EXPECT_EQ(distance(pF, stirred_body<Displacement<D>>()), 0);
  EXPECT_LT(distance(pF, stirred_body<PFJ<D>>()), 1e-14);
  EXPECT_LT(distance(pF, stirred_body<PFHJ<D>>()), 1e-14);
}

TYPED_TEST(EveryDimension, MapsFollowTheirFibreMap) {
  // dH/dt and dJ/dt are the derivatives of cof F and det F along dF/dt while the maps are those of F.
  constexpr int D = TypeParam::value;
  auto body = stirred_body<PFHJ<D>>();
  const std::vector<Mat<D>> G = velocity_gradients(body);
  const double h = 1e-7;
  for (std::int64_t a = 0; a < body.size(); ++a) {
    const Strain ahead = Strain::of(embed(Mat<D>(body.U.F[a] + h * G[a]))),
                 behind = Strain::of(embed(Mat<D>(body.U.F[a] - h * G[a])));
    const auto rates = body.map_rates(body.U, a, G[a]);
    EXPECT_LT((rates.H - (ahead.H - behind.H) / (2 * h)).norm(), 1e-7);
    EXPECT_NEAR(rates.J, (ahead.J - behind.J) / (2 * h), 1e-7);
    EXPECT_LT(rates.H_pull.norm() + std::abs(rates.J_pull), 1e-12);
  }
}

TYPED_TEST(EveryDimension, FibreMapStaysTheGradientOfThePositions) {
  // The involution curl F = 0: one operator gives dF/dt from v and F from x.
  constexpr int D = TypeParam::value;
  auto body = stirred_body<PF<D>>();
  const std::vector<Mat<D>> G = velocity_gradients(body);
  auto moved = make_body<PF<D>>(block<D>(), NoDissipation<D>{});
  std::vector<Vec<D>> x = body.U.x;
  for (std::size_t a = 0; a < x.size(); ++a)
    x[a] += 0.01 * body.velocity(static_cast<std::int64_t>(a));
  moved.deform(std::move(x));
  for (std::size_t a = 0; a < body.V.size(); ++a)
    EXPECT_LT((moved.U.F[a] - body.U.F[a] - 0.01 * G[a]).norm(), 1e-13);
}

TYPED_TEST(EveryDimension, InvolutionPenaltyPullsTheMapsBack) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = block<D>();
  auto body = make_body<PFHJ<D>>(cloud, NoDissipation<D>{}, [](auto& parts) {
    parts.involution = 0.3;
    parts.delta = 0.1;
  });
  body.U.J[4] = 1.02;
  body.U.H[5](0, 1) = 0.01;
  const double rate = 0.3 * body.wave_speed / 0.1;
  const auto pull = [&](std::int64_t a) { return body.map_rates(body.U, a, Mat<D>::Zero()); };
  EXPECT_NEAR(pull(4).J_pull / (-0.02 * rate), 1, 1e-12);
  EXPECT_NEAR(pull(5).H_pull(0, 1) / (-0.01 * rate), 1, 1e-12);
  EXPECT_EQ(pull(3).J_pull, 0);
}

TYPED_TEST(EveryDimension, DissipationSparesLinearMomentaAndTakesEnergyFromRoughOnes) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = block<D>();
  auto body = make_body<PF<D>>(cloud, jst<D>(0.125));
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    body.U.p[a] = Vec<D>::Constant(3) + 50 * cloud.X[a].head<D>();
  body.rates();
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    EXPECT_LT((body.R.p[a] - body.T[a]).norm(), 1e-9 * 1e5);
  double power = 0;
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    body.U.p[a] = Vec<D>::Constant(a % 2 == 0 ? 1 : -1);
  body.rates();
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    power += body.V[a] * body.U.p[a].dot(body.R.p[a] - body.T[a]);
  EXPECT_LT(power, 0);
}

TYPED_TEST(EveryDimension, TheRampLowersDissipationWithPlasticStrain) {
  const Kappa4 ramp{1.0 / 64, 1.0 / 4096, 0.5};
  EXPECT_EQ(ramp.at(0), 1.0 / 64);
  EXPECT_DOUBLE_EQ(ramp.at(0.25), (1.0 / 64 + 1.0 / 4096) / 2);
  EXPECT_EQ(ramp.at(0.5), 1.0 / 4096);
  EXPECT_EQ(ramp.at(2), 1.0 / 4096);
}

TYPED_TEST(EveryDimension, ShockSensorSeesAJumpAndNoSmoothPressure) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = D == 3 ? test::box_lattice(17, 5, 5, Vec3(1.6, 0.4, 0.4))
                                     : test::box_lattice(17, 9, 1, Vec3(1.6, 0.8, 0));
  auto body = make_body<PF<D>>(cloud, jst<D>(0.125, 1));
  const auto largest = [&](auto pressure) {
    std::vector<double> values;
    for (const Vec3& X : cloud.X)
      values.push_back(pressure(X));
    sense_shocks(body.dissipation, body.neighbours, values);
    return *std::max_element(body.dissipation.epsilon2.begin(), body.dissipation.epsilon2.end());
  };
  EXPECT_LT(largest([](const Vec3&) { return 1e6; }), 1e-9);
  EXPECT_LT(largest([](const Vec3& X) { return 1e6 * (3 + X[0]); }), 1e-9);
  EXPECT_LT(largest([](const Vec3& X) { return 1e6 * (3 + std::sin(X[0])); }), 2e-3);
  const double jump = largest([](const Vec3& X) { return X[0] < 0.75 ? 1e6 : 0; });
  EXPECT_GT(jump, 0.2);
  EXPECT_LE(jump, 1);
  // Far from the jump there is none of it, and near it the fourth-order term gives way.
  const auto near = static_cast<std::int64_t>(
      std::max_element(body.dissipation.epsilon2.begin(), body.dissipation.epsilon2.end()) -
      body.dissipation.epsilon2.begin());
  EXPECT_EQ(body.dissipation.fourth(near), 0);
  EXPECT_LT(body.dissipation.epsilon2[0], 1e-9);
  EXPECT_DOUBLE_EQ(body.dissipation.fourth(0), 0.125 * 1e-3);
}
