#include "solver/physics/materials/hencky.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

const Hencky law{ElasticConstants::from(17e6, 0.3)};

Mat3 stretched() {
  Mat3 F;
  F << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  return F;
}

Mat3 rotation() {
  return Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
}

Mat3 piola(const Mat3& F) {
  Hencky::History none;
  return law.piola(Strain::of(F), none);
}

} // namespace

TEST(Hencky, StressIsTheDerivativeOfItsEnergy) {
  for (const Mat3& F : {stretched(), Mat3(rotation() * stretched()), Mat3(0.6 * stretched())}) {
    const Mat3 P = piola(F);
    const double h = 1e-6;
    Mat3 difference;
    for (int i = 0; i < 9; ++i) {
      Mat3 plus = F, minus = F;
      plus.data()[i] += h;
      minus.data()[i] -= h;
      difference.data()[i] = (law.energy(Strain::of(plus), {}) - law.energy(Strain::of(minus), {})) / (2 * h);
    }
    EXPECT_LT((P - difference).norm() / P.norm(), 1e-7);
  }
}

TEST(Hencky, IsFreeOfStressAtRestAndUnderRotation) {
  EXPECT_EQ(piola(Mat3::Identity()).norm(), 0);
  EXPECT_LT(piola(rotation()).norm() / law.elastic.mu, 1e-14);
}

TEST(Hencky, IsObjectiveAndIsotropic) {
  const Mat3 Q = rotation(), F = stretched(), P = piola(F);
  EXPECT_LT((piola(Q * F) - Q * P).norm() / P.norm(), 1e-13);
  EXPECT_LT((piola(F * Q) - P * Q).norm() / P.norm(), 1e-13);
}

TEST(Hencky, LinearisesToHookesLaw) {
  Mat3 e;
  e << 1, 0.4, -0.2, 0.4, -0.5, 0.3, -0.2, 0.3, 0.7;
  const double small = 1e-7;
  const Mat3 hooke = 2 * law.elastic.mu * e + law.elastic.lambda * e.trace() * Mat3::Identity();
  EXPECT_LT((piola(Mat3::Identity() + small * e) / small - hooke).norm() / hooke.norm(), 1e-6);
}

TEST(Hencky, PressureFollowsTheGivenVolumeAndAreaMaps) {
  // In {p, F, J} the volume map is a field of its own: with J = 1 only the deviator is left.
  Strain strain = Strain::of(1.2 * Mat3::Identity());
  strain.J = 1;
  Hencky::History none;
  EXPECT_LT(law.piola(strain, none).norm() / law.elastic.mu, 1e-14);
}
