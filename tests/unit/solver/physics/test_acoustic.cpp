#include "solver/physics/materials/acoustic.hpp"

#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/materials/saint_venant_kirchhoff.hpp"
#include "tests/unit/solver/physics/laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr ElasticConstants moduli = ElasticConstants::from(17e6, 0.3);

Mat3 diagonal(double a, double b, double c) {
  return Vec3(a, b, c).asDiagonal();
}

std::vector<Vec3> directions() {
  std::vector<Vec3> N;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      N.push_back(Vec3(i, j, 4 - i - j).normalized());
  return N;
}

template <class L>
class Waves : public ::testing::Test {
 protected:
  const L law = test::example_law<L>();
  const ElasticConstants elastic = law.linearised();
};

using All = ::testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean, MooneyRivlin, Ogden, Hencky>;
using Finite = ::testing::Types<SaintVenantKirchhoff, NeoHookean, MooneyRivlin, Ogden, Hencky>;

template <class L>
class StiffeningWaves : public Waves<L> {};

TYPED_TEST_SUITE(Waves, All);
TYPED_TEST_SUITE(StiffeningWaves, Finite);

} // namespace

TYPED_TEST(Waves, AtRestHaveTheModuliOfSmallStrains) {
  const Elasticity at_rest = elasticity_of(this->law, Mat3::Identity());
  for (const Vec3& N : directions()) {
    const Vec3 modulus = wave_moduli(at_rest.acoustic(N));
    EXPECT_NEAR(modulus[2] / this->elastic.pressure_wave_modulus(), 1, 1e-10);
    EXPECT_NEAR(modulus[1] / this->elastic.mu, 1, 1e-10);
    EXPECT_NEAR(modulus[0] / this->elastic.mu, 1, 1e-10);
  }
}

TYPED_TEST(Waves, ElasticityIsSymmetricAndReadsBothWays) {
  Mat3 F;
  F << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  const Elasticity at = elasticity_of(this->law, F);
  EXPECT_LT((at.matrix() - at.matrix().transpose()).norm() / at.matrix().norm(), 1e-11);
  const Vec3 N = Vec3(0.3, -0.5, 0.8).normalized(), m = Vec3(1, 0.2, -0.4).normalized();
  EXPECT_NEAR(m.dot(at.acoustic(N) * m) / N.dot(at.polarised(m) * N), 1, 1e-14);
}

TYPED_TEST(StiffeningWaves, TurnWithTheBody) {
  const Mat3 Q = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  const Mat3 F = diagonal(1.6, 0.8, 0.7);
  const Vec3 N = Vec3(0.3, -0.5, 0.8).normalized();
  const Vec3 modulus = wave_moduli(elasticity_of(this->law, F).acoustic(N));
  const Vec3 turned = wave_moduli(elasticity_of(this->law, Q * F).acoustic(N));
  const Vec3 turned_first = wave_moduli(elasticity_of(this->law, F * Q.transpose()).acoustic(Q * N));
  EXPECT_LT((turned - modulus).norm() / modulus.norm(), 1e-9);
  EXPECT_LT((turned_first - modulus).norm() / modulus.norm(), 1e-9);
}

TYPED_TEST(StiffeningWaves, StiffenedModulusIsThatOfThePrincipalDirections) {
  static_assert(StiffeningLaw<TypeParam>);
  for (const Vec3& stretches :
       {Vec3(1, 1, 1), Vec3(0.7, 0.9, 1.8), Vec3(0.8, 0.8, 0.8), Vec3(3, 0.6, 0.58), Vec3(0.3, 1, 3)}) {
    const Mat3 F = stretches.asDiagonal();
    const Elasticity at = elasticity_of(this->law, F);
    double largest = 0;
    for (int i = 0; i < 3; ++i)
      largest = std::max(largest, at.acoustic(Vec3::Unit(i))(i, i));
    EXPECT_NEAR(this->law.stiffened_modulus(Strain::of(F), squared_stretches(F)) / largest, 1, 1e-9)
        << stretches;
  }
  EXPECT_NEAR(this->law.stiffened_modulus(Strain::of(Mat3::Identity()), Vec3::Ones()),
              this->elastic.pressure_wave_modulus(), 1e-14 * this->elastic.pressure_wave_modulus());
}

TYPED_TEST(StiffeningWaves, NoneIsFasterThanTheStepAllowsFor) {
  // Stretches of 0.3 to 3, all directions: the fastest wave of each against largest_wave_modulus.
  constexpr int pieces = 8;
  const auto stretch = [](int i) { return 0.3 * std::pow(10.0, i / double(pieces)); };
  double closest = 0;
  for (int i = 0; i <= pieces; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k) {
        const Mat3 F = diagonal(stretch(i), stretch(j), stretch(k));
        const Elasticity at = elasticity_of(this->law, F);
        const double bound = largest_wave_modulus(this->law, Strain::of(F));
        for (Vec3 N : directions()) {
          // Up the hill of m.Q(N).m, in m and N by turns.
          for (int turn = 0; turn < 3; ++turn) {
            const Eigen::SelfAdjointEigenSolver<Mat3> waves(at.acoustic(N));
            closest = std::max(closest, waves.eigenvalues()[2] / bound);
            N = Eigen::SelfAdjointEigenSolver<Mat3>(at.polarised(waves.eigenvectors().col(2)))
                    .eigenvectors()
                    .col(2);
          }
        }
      }
  EXPECT_LT(closest, 1 + 1e-6);
  EXPECT_GT(closest, 1 - 1e-3); // nor is it more careful than it must be
}

TEST(Acoustic, NeoHookeanStretchedInOneDirection) {
  // F = diag(s, 1, 1): Psi = mu/2 (s^(-2/3) (s^2 + 2) - 3) + kappa/2 (s - 1)^2, twice differentiated.
  const NeoHookean law{moduli};
  const double mu = moduli.mu, kappa = moduli.kappa;
  for (const double s : {0.6, 1.0, 1.7, 2.5}) {
    const Elasticity at = elasticity_of(law, diagonal(s, 1, 1));
    const double root = std::pow(s, -2.0 / 3);
    const double along =
        mu / 2 * (4.0 / 9 * std::pow(s, -2.0 / 3) + 20.0 / 9 * std::pow(s, -8.0 / 3)) + kappa;
    const Mat3 Q = at.acoustic(Vec3::UnitX());
    EXPECT_NEAR(Q(0, 0) / along, 1, 1e-10);
    // Transverse displacement of planes X = const leaves J: d^2/dg^2 of mu/2 J^(-2/3) (F:F).
    EXPECT_NEAR(Q(1, 1) / (mu * root), 1, 1e-10);
    EXPECT_NEAR(Q(2, 2) / (mu * root), 1, 1e-10);
    EXPECT_LT((Q - Mat3(Q.diagonal().asDiagonal())).norm() / Q.norm(), 1e-10);
    // Across: y'' = 1 + g, J = s (1 + g): d^2/dg^2 [mu/2 s^(-2/3) (1 + g)^(-2/3) (s^2 + 1 + (1 + g)^2)
    // + kappa/2 (s (1 + g) - 1)^2] at g = 0.
    const double across = mu / 2 * root * (10.0 / 9 * (s * s + 1) + 4.0 / 9) + kappa * s * s;
    const Mat3 Q_across = at.acoustic(Vec3::UnitY());
    EXPECT_NEAR(Q_across(1, 1) / across, 1, 1e-10);
    EXPECT_NEAR(Q_across(0, 0) / (mu * root), 1, 1e-10);
    EXPECT_NEAR(Q_across(2, 2) / (mu * root), 1, 1e-10);
  }
}

TEST(Acoustic, SaintVenantKirchhoffStretchedInOneDirection) {
  // P_11 = (lambda + 2 mu) s E with E = (s^2 - 1)/2: its slope along the stretch, no waves below 1/sqrt(3);
  // the planes across it slide against mu and the stress on them.
  const SaintVenantKirchhoff law{moduli};
  const double M = moduli.pressure_wave_modulus(), mu = moduli.mu;
  for (const double s : {0.5, 0.7, 1.0, 1.7}) {
    const Mat3 Q = elasticity_of(law, diagonal(s, 1, 1)).acoustic(Vec3::UnitX());
    const double E = 0.5 * (s * s - 1);
    EXPECT_NEAR(Q(0, 0), M * (3 * s * s - 1) / 2, 1e-10 * M);
    EXPECT_NEAR(Q(1, 1), M * E + mu, 1e-10 * M);
    EXPECT_NEAR(Q(2, 2), M * E + mu, 1e-10 * M);
  }
}

TEST(Acoustic, SpeedsAreThoseOfTheModuli) {
  EXPECT_DOUBLE_EQ(wave_speed(117e9, 8930), std::sqrt(117e9 / 8930));
  EXPECT_TRUE(std::isnan(wave_speed(-1, 8930)));
}
