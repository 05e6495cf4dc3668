#include "solver/scene/error_norms.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera;
using namespace tessera::solver;

TEST(ErrorNorms, AreThoseOfTheirDefinitions) {
  ParticleCloud cloud;
  cloud.X = {Vec3(0, 0, 0), Vec3(2, 0, 0)};
  cloud.V = {0.25, 0.75};
  const ExactSolution exact{Formulas{Expression("X*t"), Expression("3"), Expression("0")}, Expression("10*t"),
                            Formulas{Expression("X"), Expression("0"), Expression("1")}};
  const std::vector<double> velocity = {0, 3, 2, /**/ 4, 4, 0}, pressure = {21, 17},
                            displacement = {0, 4, 1, /**/ 2, 0, 2};
  const ErrorNorms norms = error_norms(exact, 2, cloud, {displacement, velocity, pressure});
  // |e_u| = 4 and 1; |u|^2 = 1 and 5.
  EXPECT_DOUBLE_EQ(norms.l1_displacement, 0.25 * 4 + 0.75 * 1);
  EXPECT_DOUBLE_EQ(norms.l2_displacement, std::sqrt(0.25 * 16 + 0.75));
  EXPECT_DOUBLE_EQ(norms.l2_displacement_relative, std::sqrt((0.25 * 16 + 0.75) / (0.25 + 0.75 * 5)));
  // |e_v| = 2 and 1, |e_p| = 1 and 3; |v| = 3 and 5.
  EXPECT_DOUBLE_EQ(norms.l1_velocity, 0.25 * 2 + 0.75 * 1);
  EXPECT_DOUBLE_EQ(norms.l2_velocity, std::sqrt(0.25 * 4 + 0.75 * 1));
  EXPECT_DOUBLE_EQ(norms.l2_velocity_relative, std::sqrt((0.25 * 4 + 0.75) / (0.25 * 9 + 0.75 * 25)));
  EXPECT_DOUBLE_EQ(norms.l2_velocity_thesis, std::hypot(0.5, 0.75));
  EXPECT_DOUBLE_EQ(norms.l1_pressure, 0.25 * 1 + 0.75 * 3);
  EXPECT_DOUBLE_EQ(norms.l2_pressure, std::sqrt(0.25 * 1 + 0.75 * 9));
  EXPECT_DOUBLE_EQ(norms.l2_pressure_relative, std::sqrt(0.25 + 6.75) / 20);
}

TEST(ErrorNorms, OfFieldsWithoutAClosedFormAreZero) {
  ParticleCloud cloud;
  cloud.X = {Vec3(1, 0, 0)};
  cloud.V = {2};
  ExactSolution exact;
  exact.displacement = Formulas{Expression("0"), Expression("0"), Expression("0")};
  const std::vector<double> moved = {3, 0, 0}, fast = {1, 1, 1}, pressed = {5};
  const ErrorNorms norms = error_norms(exact, 0, cloud, {moved, fast, pressed});
  EXPECT_DOUBLE_EQ(norms.l1_displacement, 6);
  EXPECT_EQ(norms.l2_displacement_relative, 0); // nothing to relate it to
  EXPECT_EQ(norms.l2_velocity, 0);
  EXPECT_EQ(norms.l2_pressure, 0);
}
