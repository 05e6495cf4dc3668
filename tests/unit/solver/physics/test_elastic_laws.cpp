// What every elastic law must be: the derivative of its energy, objective, isotropic, Hooke's at small
// strains.

#include "solver/physics/law.hpp"
#include "solver/physics/stress_measures.hpp"
#include "tests/unit/solver/physics/laws.hpp"

#include <gtest/gtest.h>

#include <functional>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr ElasticConstants moduli = ElasticConstants::from(17e6, 0.3);

Mat3 rotation() {
  return Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
}

Mat3 stretched() {
  Mat3 F;
  F << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  return F;
}

Mat3 diagonal(double a, double b, double c) {
  return Vec3(a, b, c).asDiagonal();
}

/// Central differences of f over the nine components of A.
Mat3 slope(const Mat3& A, const std::function<double(const Mat3&)>& f) {
  const double h = 1e-6;
  Mat3 difference;
  for (int i = 0; i < 9; ++i) {
    Mat3 plus = A, minus = A;
    plus.data()[i] += h;
    minus.data()[i] -= h;
    difference.data()[i] = (f(plus) - f(minus)) / (2 * h);
  }
  return difference;
}

template <class L>
class ElasticLaw : public ::testing::Test {
 protected:
  Mat3 piola(const Strain& strain) const {
    typename L::History none;
    return law.piola(strain, none);
  }
  Mat3 piola(const Mat3& F) const { return piola(Strain::of(F)); }
  double energy(const Strain& strain) const { return law.energy(strain, {}); }

  const L law = test::example_law<L>();
  const ElasticConstants elastic = law.linearised();
};

/// Laws of large rotations.
template <class L>
class FiniteLaw : public ElasticLaw<L> {};

using All = ::testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean, MooneyRivlin, Ogden, Hencky>;
using Finite = ::testing::Types<SaintVenantKirchhoff, NeoHookean, MooneyRivlin, Ogden, Hencky>;
TYPED_TEST_SUITE(ElasticLaw, All);
TYPED_TEST_SUITE(FiniteLaw, Finite);

} // namespace

TYPED_TEST(ElasticLaw, StressIsTheDerivativeOfItsEnergy) {
  // Equal and nearly equal stretches among them: principal axes are arbitrary there.
  for (const Mat3& F :
       {stretched(), Mat3(rotation() * stretched()), Mat3(0.7 * stretched()), diagonal(1.2, 1.2, 1.2),
        diagonal(1.4, 0.9, 0.9), diagonal(1.1, 1.1 + 1e-9, 0.8), diagonal(2.5, 0.7, 0.6)}) {
    const Mat3 P = this->piola(F);
    const Mat3 difference = slope(F, [&](const Mat3& G) { return this->energy(Strain::of(G)); });
    EXPECT_LT((P - difference).norm() / P.norm(), 1e-7) << F;
  }
}

TYPED_TEST(ElasticLaw, StressJoinsItsConjugatesInEveryFormulation) {
  // P = Sigma_F + Sigma_H x F + Sigma_J H, (2.131): with J of its own, {p, F, J}; with H and J of their own,
  // {p, F, H, J}; and all derivatives come to the same where H and J are those of F.
  const auto energy_at = [&](const Mat3& F, const Mat3& H, double J) { return this->energy({F, H, J}); };
  const auto by_J = [&](const Strain& at) {
    const double h = 1e-6;
    return (energy_at(at.F, at.H, at.J + h) - energy_at(at.F, at.H, at.J - h)) / (2 * h);
  };
  const auto three_maps = [&](const Strain& at) -> Mat3 {
    const Mat3 by_F = slope(at.F, [&](const Mat3& F) { return energy_at(F, at.H, at.J); });
    const Mat3 by_H = slope(at.H, [&](const Mat3& H) { return energy_at(at.F, H, at.J); });
    return by_F + cross(by_H, at.F) + by_J(at) * at.H;
  };
  const auto two_maps = [&](const Strain& at) -> Mat3 {
    return slope(at.F, [&](const Mat3& F) { return energy_at(F, cofactor(F), at.J); }) + by_J(at) * at.H;
  };
  const Strain of_F = Strain::of(stretched());
  Strain own_J = of_F;
  own_J.J = 0.93;
  Strain own_H = own_J;
  own_H.H = cofactor(rotation() * diagonal(1.1, 0.9, 1.05));
  const auto error = [&](const Strain& at, const Mat3& expected) {
    return (this->piola(at) - expected).norm() / expected.norm();
  };
  EXPECT_LT(error(own_H, three_maps(own_H)), 1e-7);
  EXPECT_LT(error(own_J, three_maps(own_J)), 1e-7);
  EXPECT_LT(error(own_J, two_maps(own_J)), 1e-7);
  EXPECT_LT(error(of_F, three_maps(of_F)), 1e-7);
  EXPECT_LT(error(of_F, two_maps(of_F)), 1e-7);
}

TYPED_TEST(ElasticLaw, IsFreeOfStressAndEnergyAtRest) {
  EXPECT_EQ(this->piola(Mat3::Identity()).norm(), 0);
  EXPECT_EQ(this->energy(Strain::of(Mat3::Identity())), 0);
}

TYPED_TEST(ElasticLaw, LinearisesToHookesLaw) {
  Mat3 e;
  e << 1, 0.4, -0.2, 0.4, -0.5, 0.3, -0.2, 0.3, 0.7;
  const double small = 1e-5;
  const auto at = [&](const Mat3& strain) -> Mat3 { // a central difference: nothing quadratic is left
    return (this->piola(Mat3::Identity() + small * strain) - this->piola(Mat3::Identity() - small * strain)) /
           (2 * small);
  };
  const ElasticConstants& m = this->elastic;
  const Mat3 hooke = 2 * m.mu * e + m.lambda * e.trace() * Mat3::Identity();
  EXPECT_LT((at(e) - hooke).norm() / hooke.norm(), 1e-7);
  // The bar of Young's modulus and Poisson's ratio.
  const Mat3 pull = at(diagonal(1, -m.poisson(), -m.poisson()));
  EXPECT_LT((pull - diagonal(m.young(), 0, 0)).norm() / m.young(), 1e-7);
}

TYPED_TEST(ElasticLaw, PlaneStrainIsTheSolidHeldAtItsThickness) {
  Mat<2> F;
  F << 1.2, 0.3, -0.1, 0.85;
  const Mat3 P = this->piola(embed(F));
  // Nothing but a normal stress acts across the plane, and turning the plane in space turns the stress.
  EXPECT_EQ(P(0, 2), 0);
  EXPECT_EQ(P(1, 2), 0);
  EXPECT_EQ(P(2, 0), 0);
  EXPECT_EQ(P(2, 1), 0);
  Mat<2> difference;
  const double h = 1e-6;
  for (int i = 0; i < 4; ++i) {
    Mat<2> plus = F, minus = F;
    plus.data()[i] += h;
    minus.data()[i] -= h;
    difference.data()[i] =
        (this->energy(Strain::of(embed(plus))) - this->energy(Strain::of(embed(minus)))) / (2 * h);
  }
  EXPECT_LT((P.topLeftCorner<2, 2>() - difference).norm() / P.norm(), 1e-7);
  const Mat3 lifted = slope(embed(F), [&](const Mat3& G) { return this->energy(Strain::of(G)); });
  EXPECT_NEAR(P(2, 2) / lifted(2, 2), 1, 1e-7);
}

TYPED_TEST(FiniteLaw, IsObjectiveAndIsotropic) {
  const Mat3 Q = rotation(), F = stretched(), P = this->piola(F);
  EXPECT_LT((this->piola(Q * F) - Q * P).norm() / P.norm(), 1e-13);
  EXPECT_LT((this->piola(F * Q) - P * Q).norm() / P.norm(), 1e-13);
  EXPECT_LT(this->piola(Q).norm() / this->elastic.mu, 1e-13);
}

TYPED_TEST(FiniteLaw, KirchhoffStressIsSymmetric) {
  for (const Mat3& F : {stretched(), Mat3(rotation() * diagonal(2.5, 0.7, 0.6))}) {
    const Mat3 tau = this->piola(F) * F.transpose();
    EXPECT_LT((tau - tau.transpose()).norm() / tau.norm(), 1e-14);
  }
}

TEST(LinearElastic, IsLinearAndFeelsRotations) {
  const LinearElastic law{moduli};
  LinearElastic::History none;
  const Mat3 e = stretched() - Mat3::Identity();
  const auto piola = [&](const Mat3& F) { return law.piola(Strain::of(F), none); };
  EXPECT_LT((piola(Mat3::Identity() + 2 * e) - 2 * piola(Mat3::Identity() + e)).norm() / moduli.mu, 1e-14);
  EXPECT_GT(piola(rotation()).norm() / moduli.mu, 0.1);
}

TEST(SaintVenantKirchhoff, UniaxialStretchIsTheCubicOfItsLaw) {
  const SaintVenantKirchhoff law{moduli};
  SaintVenantKirchhoff::History none;
  const double stretch = 1.7, green = 0.5 * (stretch * stretch - 1);
  const Mat3 P = law.piola(Strain::of(diagonal(stretch, 1, 1)), none);
  EXPECT_NEAR(P(0, 0) / (stretch * moduli.pressure_wave_modulus() * green), 1, 1e-14);
  EXPECT_NEAR(P(1, 1) / (moduli.lambda * green), 1, 1e-14);
}

TEST(Rubber, OneLawIsASpecialCaseOfTheNext) {
  const Strain strain = Strain::of(stretched());
  const double c1 = 2e6, c2 = 0.7e6, kappa = 12e6;
  NeoHookean::History none;
  MooneyRivlin::History no_memory;
  Ogden::History nothing;
  const Mat3 neo = NeoHookean{ElasticConstants::from_shear_and_bulk(2 * c1, kappa)}.piola(strain, none);
  const Mat3 mooney = MooneyRivlin{c1, 0, kappa}.piola(strain, no_memory);
  EXPECT_LT((neo - mooney).norm() / neo.norm(), 1e-14);
  // (2.101) with c2 = -mu_2 / 2; the volumetric parts differ, the deviators must not.
  const auto deviator = [&](const Mat3& P) -> Mat3 {
    const Mat3 sigma = cauchy(P, strain.F, strain.J);
    return sigma - pressure(sigma) * Mat3::Identity();
  };
  const Mat3 by_invariants = deviator(MooneyRivlin{c1, c2, kappa}.piola(strain, no_memory));
  const Mat3 by_stretches = deviator(Ogden{{{2 * c1, 2}, {-2 * c2, -2}}, kappa}.piola(strain, nothing));
  EXPECT_LT((by_invariants - by_stretches).norm() / by_invariants.norm(), 1e-13);
}

TEST(Ogden, PressureOfABareVolumeChange) {
  const Ogden law = test::example_law<Ogden>();
  Ogden::History none;
  const double J = 0.85;
  const Strain strain = Strain::of(std::cbrt(J) * rotation());
  const Mat3 sigma = cauchy(law.piola(strain, none), strain.F, J);
  const double expected = law.kappa / (9 * J) * (1 - std::pow(J, -9));
  EXPECT_LT((sigma - expected * Mat3::Identity()).norm() / std::abs(expected), 1e-13);
}
