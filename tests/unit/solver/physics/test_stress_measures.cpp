#include "solver/physics/stress_measures.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

TEST(StressMeasures, UniaxialTension) {
  const Mat3 sigma = Vec3(9, 0, 0).asDiagonal();
  EXPECT_DOUBLE_EQ(pressure(sigma), 3);
  EXPECT_DOUBLE_EQ(von_mises(sigma), 9);
}

TEST(StressMeasures, PureShearAndHydrostatic) {
  Mat3 sigma = Mat3::Zero();
  sigma(0, 1) = sigma(1, 0) = 2;
  EXPECT_NEAR(von_mises(sigma), 2 * std::sqrt(3.0), 1e-14);
  EXPECT_EQ(von_mises(5 * Mat3::Identity()), 0);
}

TEST(StressMeasures, CauchyOfAPullByNansonsFormula) {
  // A bar stretched to twice its length at constant cross-section carries sigma = P.
  const Mat3 F = Vec3(2, 1, 1).asDiagonal();
  const Mat3 P = Vec3(7, 0, 0).asDiagonal();
  EXPECT_DOUBLE_EQ(cauchy(P, F, 2)(0, 0), 7);
}
