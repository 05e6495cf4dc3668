#include "solver/boundary/wall.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double density = 2, dt = 0.1;

/// Momentum after the wall z = 0 has acted on one particle at height z with momentum p.
Vec3 after(double z, const Vec3& p, double restitution, Vec3* impulse = nullptr) {
  std::vector<Vec3> x = {Vec3(0.3, 0.4, z)}, momentum = {p}, given = {Vec3::Zero()};
  const Plane<3> wall{Vec3::Zero(), Vec3::UnitZ(), restitution};
  wall.apply(x, momentum, density, dt, 0.5, given);
  if (impulse != nullptr)
    *impulse = given[0];
  return momentum[0];
}

} // namespace

TEST(Plane, LetsParticlesPassThatDoNotReachIt) {
  EXPECT_EQ(after(1, Vec3(1, 2, -3), 0), Vec3(1, 2, -3));
  EXPECT_EQ(after(0, Vec3(1, 2, 3), 0), Vec3(1, 2, 3));
}

TEST(Plane, LandsParticlesExactlyOnItWithoutTouchingTheirSlip) {
  const Vec3 p = after(0.05, Vec3(1, 2, -30), 0);
  EXPECT_EQ(p.head<2>(), Vec3(1, 2, -30).head<2>());
  EXPECT_DOUBLE_EQ(0.05 + dt * p[2] / density, 0);
}

TEST(Plane, StopsParticlesOnOrBehindIt) {
  EXPECT_EQ(after(0, Vec3(0, 0, -3), 0)[2], 0);
  EXPECT_EQ(after(-0.01, Vec3(0, 0, -3), 0)[2], 0);
}

TEST(Plane, ReflectsWithRestitution) {
  EXPECT_DOUBLE_EQ(after(0, Vec3(1, 0, -4), 0.5)[2], 2);
  EXPECT_DOUBLE_EQ(after(0, Vec3(1, 0, -4), 1)[2], 4);
}

TEST(Plane, ReportsItsShareOfTheImpulse) {
  Vec3 impulse;
  after(0, Vec3(1, 2, -3), 0, &impulse);
  EXPECT_EQ(impulse, Vec3(0, 0, 1.5));
}

TEST(Plane, MayLeanAnyWay) {
  const Vec3 normal = Vec3(1, 1, 0).normalized();
  std::vector<Vec3> x = {Vec3::Zero()}, p = {Vec3(-2, 0, 1)}, impulse = {Vec3::Zero()};
  Plane<3>{Vec3::Zero(), normal, 0}.apply(x, p, density, dt, 1, impulse);
  EXPECT_NEAR(p[0].dot(normal), 0, 1e-15);
  EXPECT_LT((p[0] - Vec3(-1, 1, 1)).norm(), 1e-15);
}
