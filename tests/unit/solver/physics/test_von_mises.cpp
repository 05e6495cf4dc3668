#include "solver/physics/plasticity/von_mises.hpp"

#include "solver/physics/plasticity/hardening.hpp"
#include "solver/physics/stress_measures.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double young = 117e9, poisson = 0.35, yield = 0.4e9, modulus = 0.1e9;
using Law = VonMises<LinearHardening>;
const Law law{Hencky{ElasticConstants::from(young, poisson)}, {yield, modulus}};

/// F of uniaxial stress with equivalent plastic strain eps: in logarithmic strains the axial one is tau / E +
/// eps and the lateral ones -nu tau / E - eps / 2, with tau = yield + modulus eps.
Mat3 uniaxial(double eps) {
  const double tau = yield + modulus * eps;
  return Vec3(std::exp(tau / young + eps), std::exp(-poisson * tau / young - eps / 2),
              std::exp(-poisson * tau / young - eps / 2))
      .asDiagonal();
}

Mat3 kirchhoff(const Mat3& F, Law::History& history) {
  return law.piola(Strain::of(F), history) * F.transpose();
}

Mat3 rotation(double angle) {
  return Eigen::AngleAxisd(angle, Vec3(1, -1, 2).normalized()).toRotationMatrix();
}

} // namespace

TEST(VonMises, FollowsTheAnalyticUniaxialPath) {
  for (const int steps : {1, 7, 100}) {
    Law::History history;
    for (int i = 1; i <= steps; ++i) {
      const double eps = 1.5 * i / steps;
      const Mat3 tau = kirchhoff(uniaxial(eps), history);
      EXPECT_NEAR(tau(0, 0) / (yield + modulus * eps), 1, 1e-10);
      EXPECT_LT(std::abs(tau(1, 1)) / yield, 1e-10);
      EXPECT_NEAR(history.equivalent_plastic_strain, eps, 1e-12);
    }
  }
}

TEST(VonMises, FollowsTheSamePathInARotatingFrame) {
  Law::History history;
  for (int i = 1; i <= 50; ++i) {
    const double eps = 0.8 * i / 50;
    const Mat3 Q = rotation(0.1 * i);
    const Mat3 tau = Q.transpose() * kirchhoff(Q * uniaxial(eps), history) * Q;
    EXPECT_NEAR(tau(0, 0) / (yield + modulus * eps), 1, 1e-10);
  }
}

TEST(VonMises, IsHenckyBelowYield) {
  Law::History history;
  Hencky::History none;
  const Strain strain = Strain::of(Mat3::Identity() + 1e-3 * Mat3(Vec3(1, -0.2, 0.3).asDiagonal()));
  EXPECT_EQ(law.piola(strain, history), law.hencky.piola(strain, none));
  EXPECT_EQ(history.equivalent_plastic_strain, 0);
}

TEST(VonMises, HoldsTheYieldSurfaceAndPlasticIncompressibilityOnAnyPath) {
  Law::History history;
  Mat3 F = Mat3::Identity();
  Mat3 rate;
  rate << 0.3, 0.5, -0.2, 0.1, -0.4, 0.6, 0.2, -0.3, 0.05;
  for (int i = 0; i < 200; ++i) {
    F = (Mat3::Identity() + 0.02 * (i % 40 < 25 ? 1.0 : -0.6) * rate) * F;
    const Mat3 tau = kirchhoff(F, history);
    EXPECT_LE(von_mises(tau), law.hardening.yield_stress(history.equivalent_plastic_strain) * (1 + 1e-10));
    EXPECT_NEAR(history.plastic_metric.determinant(), 1, 1e-10);
  }
  EXPECT_GT(history.equivalent_plastic_strain, 0.5);
}

TEST(VonMises, UnloadsElastically) {
  Law::History history;
  kirchhoff(uniaxial(0.3), history);
  const double strain_held = history.equivalent_plastic_strain;
  const Mat3 tau_loaded = kirchhoff(uniaxial(0.3), history);
  // Axial logarithmic strain taken back by d relieves 2 mu of deviator and kappa of volume.
  const double d = 1e-3;
  const Mat3 F = Vec3(std::exp(-d), 1, 1).asDiagonal() * uniaxial(0.3);
  const Mat3 tau = kirchhoff(F, history);
  const auto& e = law.hencky.elastic;
  EXPECT_NEAR((tau - tau_loaded)(0, 0), -d * e.pressure_wave_modulus(), 1e-9 * young);
  EXPECT_EQ(history.equivalent_plastic_strain, strain_held);
}

TEST(VonMises, StressIsTheDerivativeOfItsEnergyAtFixedHistory) {
  Law::History history;
  Mat3 F = uniaxial(0.4);
  kirchhoff(F, history);
  F = Vec3(std::exp(-1e-3), 1, 1).asDiagonal() * F; // inside the yield surface
  Law::History held = history;
  const Mat3 P = law.piola(Strain::of(F), held);
  const double h = 1e-6;
  Mat3 difference;
  for (int i = 0; i < 9; ++i) {
    Mat3 plus = F, minus = F;
    plus.data()[i] += h;
    minus.data()[i] -= h;
    difference.data()[i] =
        (law.energy(Strain::of(plus), history) - law.energy(Strain::of(minus), history)) / (2 * h);
  }
  EXPECT_LT((P - difference).norm() / P.norm(), 1e-7);
}

TEST(VonMises, WorkPutInIsStoredOrSpentOnPlasticFlow) {
  Law::History history;
  double work = 0;
  Mat3 F_old = Mat3::Identity(), P_old = Mat3::Zero();
  constexpr int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const double axial = 0.5 * i / steps;
    const Mat3 F = Vec3(std::exp(axial), std::exp(-0.4 * axial), std::exp(-0.5 * axial)).asDiagonal();
    const Mat3 P = law.piola(Strain::of(F), history);
    work += 0.5 * ((P + P_old).array() * (F - F_old).array()).sum();
    F_old = F;
    P_old = P;
  }
  const double accounted = law.energy(Strain::of(F_old), history) + law.plastic_work(history);
  EXPECT_NEAR(accounted / work, 1, 1e-5);
}
