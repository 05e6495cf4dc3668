#include "solver/time/critical_step.hpp"

#include "solver/time/step_limit.hpp"
#include "tests/unit/solver/physics/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

using namespace tessera;
using namespace tessera::solver;

namespace {

template <class T>
class Critical : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Critical, Dimensions);

template <int D>
ParticleCloud irregular_block() {
  return test::jittered(D == 3 ? test::box_lattice(4, 5, 4, Vec3(0.3, 0.4, 0.3))
                               : test::box_lattice(7, 8, 1, Vec3(0.6, 0.7, 0)),
                        0.3, 4);
}

template <int D>
auto irregular_body(double kappa) {
  ResidualDissipation<D> dissipation;
  dissipation.kappa = PlasticRamp::constant(kappa);
  return make_body<PF<D>>(irregular_block<D>(), dissipation);
}

/// K and C of d2p/dt2 = -K p - C dp/dt, every column by the rates of a unit momentum.
struct Matrices {
  Eigen::MatrixXd K, C;
};

template <class Body>
Matrices matrices_of(Body& body) {
  constexpr int D = Body::dimension;
  const Eigen::Index n = D * body.size();
  Matrices result{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
  const auto strains = body.strains();
  std::vector<Mat<D>> grad_u(body.V.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    for (auto& p : body.U.p)
      p.setZero();
    body.U.p[static_cast<std::size_t>(k / D)][k % D] = 1;
    for (std::int64_t a = 0; a < body.size(); ++a)
      grad_u[static_cast<std::size_t>(a)] = body.gradient_of(body.U.p, a) / body.density;
    body.send_stresses([&](std::int64_t first, std::span<Mat<D>> dP) {
      body.material->differentials(strains, grad_u, first, dP);
    });
    body.rates();
    for (std::int64_t a = 0; a < body.size(); ++a) {
      result.K.col(k).template segment<D>(D * a) = -body.T[static_cast<std::size_t>(a)];
      result.C.col(k).template segment<D>(D * a) =
          body.T[static_cast<std::size_t>(a)] - body.R.p[static_cast<std::size_t>(a)];
    }
  }
  for (auto& p : body.U.p)
    p.setZero();
  body.stresses();
  return result;
}

/// Largest amplification of a Verlet step of the linear system, its dissipation half a step behind.
double amplification(const Matrices& of, double dt) {
  const Eigen::Index n = of.K.rows();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  // u^(n+1) = u^n + dt q, q^(n+3/2) = q - dt (K u^(n+1) + C q).
  Eigen::MatrixXd step(2 * n, 2 * n);
  step << one, dt * one, -dt * of.K, one - dt * dt * of.K - dt * of.C;
  return Eigen::EigenSolver<Eigen::MatrixXd>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

} // namespace

TYPED_TEST(Critical, IsWhereVerletsStepBeginsToAmplify) {
  for (double kappa : {0.0, 0.5, 2.0}) {
    auto body = irregular_body<TypeParam::value>(kappa);
    const Matrices matrices = matrices_of(body);
    CriticalStep<decltype(body)> critical;
    critical.refine(body, 40);
    // Without dissipation every wave within the limit is carried at an amplification of 1.
    EXPECT_LT(amplification(matrices, 0.95 * critical.value()), 1 + 1e-6) << kappa;
    EXPECT_GT(amplification(matrices, 1.02 * critical.value()), 1 + 1e-3) << kappa;
  }
}

TYPED_TEST(Critical, CountsTheDissipationOfJ) {
  // Alone J bears 2 / C_J, which here is far below what the momenta bear.
  constexpr int D = TypeParam::value;
  const auto critical_with = [](double kappa, double kappa_J) {
    ResidualDissipation<D, true> dissipation;
    dissipation.kappa = PlasticRamp::constant(kappa);
    dissipation.kappa_J = kappa_J;
    auto body = make_body<PFJ<D>>(irregular_block<D>(), dissipation);
    CriticalStep<decltype(body)> critical;
    critical.refine(body, 60);
    return critical.value();
  };
  EXPECT_NEAR(critical_with(0.1, 40) / critical_with(0.1, 20), 0.5, 0.02);
  EXPECT_NEAR(critical_with(20, 0.1) / critical_with(0.1, 20), 1, 0.05);
  EXPECT_LT(critical_with(1, 1), 0.95 * critical_with(1, 0.01));
}

TYPED_TEST(Critical, LeavesTheBodyAsItWas) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  ResidualDissipation<D, true> dissipation;
  dissipation.kappa_J = 1;
  auto body = make_body<PFJ<D>>(cloud, dissipation);
  deform_and_stir(body, cloud);
  body.rates();
  const auto U = body.U, R = body.R;
  const auto T = body.T;
  const auto pull = body.pull;
  CriticalStep<decltype(body)>{}.refine(body, 3);
  EXPECT_EQ(body.U.p, U.p);
  EXPECT_EQ(body.U.F, U.F);
  EXPECT_EQ(body.U.J, U.J);
  EXPECT_EQ(body.R.p, R.p);
  EXPECT_EQ(body.R.J, R.J);
  EXPECT_EQ(body.T, T);
  EXPECT_EQ(body.pull, pull);
}

TYPED_TEST(Critical, FollowsABodyAsItIsSqueezed) {
  // At a constant volume, to half the width: waves take half the time through it.
  constexpr int D = TypeParam::value;
  auto body = irregular_body<D>(0);
  StepLimit<decltype(body)> limit(1, std::numeric_limits<double>::infinity(), 1);
  const double at_rest = limit(body);
  for (int i = 0; i <= 200; ++i) {
    const double squeeze = 1 - 0.5 * i / 200;
    for (auto& F : body.U.F) {
      F *= std::pow(squeeze, -1.0 / (D - 1)) / F(1, 1); // the others, so that the volume stays
      F(0, 0) = squeeze;
    }
    body.commit();
    limit(body);
  }
  auto squeezed = irregular_body<D>(0);
  squeezed.U.F = body.U.F;
  squeezed.commit();
  CriticalStep<decltype(body)> afresh;
  afresh.refine(squeezed, 80);
  EXPECT_NEAR(limit(body) / afresh.value(), 1, 0.05);
  EXPECT_LT(afresh.value(), 0.7 * at_rest);
}

TYPED_TEST(Critical, ALimitByDistanceIsThatOfTheFastestWave) {
  auto body = irregular_body<TypeParam::value>(0);
  StepLimit<decltype(body)> limit(0.1, 0.1, 0);
  EXPECT_DOUBLE_EQ(limit(body), 0.01 / body.fastest_wave());
  EXPECT_EQ(limit.critical(), 0);
}
