#include "solver/boundary/wall.hpp"

#include "solver/boundary/polyline.hpp"
#include "tests/unit/solver/boundary/free_particle.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double density = 2, dt = 0.1;

ContactLaw restitution(double e) {
  return {ContactMethod::reflection, 0, e, 0};
}

Wall<3> floor_with(const ContactLaw& law, const Vec3& velocity = Vec3::Zero(),
                   const Vec3& normal = Vec3::UnitZ()) {
  return {"floor", std::make_shared<Plane>(Vec3::Zero(), normal), law, velocity, 1};
}

/// Momentum after the wall z = 0 has acted on one particle at height z with momentum p in the last stage.
Vec3 after(double z, const Vec3& p, double e, double share = 1, Vec3* impulse = nullptr) {
  std::vector<Vec3> x = {Vec3(0.3, 0.4, z)}, momentum = {p}, given = {Vec3::Zero()};
  floor_with(restitution(e)).limit(x, momentum, density, 0, dt, share, given);
  if (impulse != nullptr)
    *impulse = given[0];
  return momentum[0];
}

} // namespace

TEST(Wall, LetsParticlesPassThatDoNotReachIt) {
  EXPECT_EQ(after(1, Vec3(1, 2, -3), 0), Vec3(1, 2, -3));
  EXPECT_EQ(after(0, Vec3(1, 2, 3), 0), Vec3(1, 2, 3));
}

TEST(Wall, LandsParticlesExactlyOnItWithoutTouchingTheirSlip) {
  const Vec3 p = after(0.05, Vec3(1, 2, -30), 0);
  EXPECT_EQ(p.head<2>(), Vec3(1, 2, -30).head<2>());
  EXPECT_NEAR(0.05 + dt * p[2] / density, 0, 1e-17);
}

TEST(Wall, StopsParticlesOnOrBehindIt) {
  EXPECT_EQ(after(0, Vec3(0, 0, -3), 0)[2], 0);
  EXPECT_EQ(after(-0.01, Vec3(0, 0, -3), 0)[2], 0);
}

TEST(Wall, ReflectsWithRestitutionInTheLastStage) {
  EXPECT_DOUBLE_EQ(after(0, Vec3(1, 0, -4), 0.5)[2], 2);
  EXPECT_DOUBLE_EQ(after(0, Vec3(1, 0, -4), 1)[2], 4);
  EXPECT_DOUBLE_EQ(after(0, Vec3(1, 0, -4), 1, 0.5)[2], 0);
}

TEST(Wall, GivesItsShareOfTheImpulse) {
  Vec3 impulse;
  after(0, Vec3(1, 2, -3), 0, 0.5, &impulse);
  EXPECT_EQ(impulse, Vec3(0, 0, 1.5));
}

TEST(Wall, MayLeanAnyWay) {
  const Vec3 normal = Vec3(1, 1, 0).normalized();
  std::vector<Vec3> x = {Vec3::Zero()}, p = {Vec3(-2, 0, 1)}, impulse = {Vec3::Zero()};
  floor_with(restitution(0), Vec3::Zero(), normal).limit(x, p, density, 0, dt, 1, impulse);
  EXPECT_NEAR(p[0].dot(normal), 0, 1e-15);
  EXPECT_LT((p[0] - Vec3(-1, 1, 1)).norm(), 1e-15);
}

TEST(Wall, ThrowsAFreeParticleBackWithItsRestitutionThroughWholeSteps) {
  for (const double e : {0.0, 0.3, 0.5, 1.0})
    for (const double height : {0.02, 0.1, 0.123, 0.199}) {
      FreeParticle<3> particle{{0, 0, height}, {0.5, 0, -1}, density, {floor_with(restitution(e))}};
      particle.start(dt);
      double lowest = height;
      for (int i = 0; i < 60; ++i) {
        particle.step(dt, Vec3::Zero());
        lowest = std::min(lowest, particle.x[0][2]);
      }
      EXPECT_NEAR(particle.velocity()[2], e, 1e-14) << height;
      EXPECT_EQ(particle.velocity()[0], 0.5);
      EXPECT_GE(lowest, -1e-16) << e;
      // The impulse is all that changed the momentum.
      EXPECT_NEAR(particle.impulse[0][2], density * (1 + e), 1e-14);
    }
}

TEST(Wall, NoStepLeavesAPositionBehindItEvenWhereStepsGrow) {
  FreeParticle<3> particle{{0, 0, 0.5}, {0, 0, -1}, density, {floor_with(restitution(0))}};
  particle.start(0.05);
  for (int i = 0; i < 40; ++i) {
    particle.step(i % 2 == 0 ? 0.05 : 0.1, Vec3(0, 0, i < 10 ? -10 : -30 * (i % 3)));
    ASSERT_GE(particle.x[0][2], -1e-16) << i;
  }
  EXPECT_NEAR(particle.x[0][2], 0, 1e-16);
}

TEST(Wall, ASlidingBlockLosesMuGAndStops) {
  const double mu = 0.3, g = 10;
  FreeParticle<3> block{{0, 0, 0}, {1, 2, 0}, density, {floor_with({ContactMethod::reflection, mu, 0, 0})}};
  const Vec3 weight(0, 0, -g);
  const double speed = std::sqrt(5.0);
  const int steps = 5;
  for (int i = 0; i < steps; ++i)
    block.step(dt, weight);
  EXPECT_NEAR(block.velocity().norm(), speed - steps * mu * g * dt, 1e-14);
  EXPECT_NEAR(block.velocity()[1], 2 * block.velocity()[0], 1e-14); // straight on
  for (int i = 0; i < 20; ++i)
    block.step(dt, weight);
  EXPECT_LT(block.velocity().norm(), 1e-15);
  EXPECT_NEAR(block.x[0][2], 0, 1e-16);
}

TEST(Wall, ABlockSticksOnASlopeBelowItsFrictionAngleAndSlidesAboveIt) {
  const double mu = 0.5, g = 10;
  const auto speed = [&](double angle, ContactMethod method) {
    FreeParticle<3> block{{0, 0, 0}, {0, 0, 0}, density, {floor_with({method, mu, 0, 1e4})}};
    if (method == ContactMethod::penalty)
      block.x[0][2] = -density * g * std::cos(angle) / 1e4;
    for (int i = 0; i < 100; ++i)
      block.step(0.001, g * Vec3(std::sin(angle), 0, -std::cos(angle)));
    return block.velocity()[0];
  };
  for (const ContactMethod method : {ContactMethod::reflection, ContactMethod::penalty}) {
    EXPECT_NEAR(speed(std::atan(0.49), method), 0, 1e-15);
    const double slides = std::atan(0.6);
    EXPECT_NEAR(speed(slides, method), 0.1 * g * (std::sin(slides) - mu * std::cos(slides)), 1e-12);
  }
}

TEST(Wall, APenaltyHoldsARestingParticleAtItsAnalyticDepth) {
  const double spring = 2e4, g = 10;
  FreeParticle<3> particle{
      {0, 0, 0}, {0, 0, 0}, density, {floor_with({ContactMethod::penalty, 0, 0, spring})}};
  for (int i = 0; i < 2000; ++i)
    particle.step(0.002, Vec3(0, 0, -g));
  EXPECT_NEAR(particle.x[0][2], -density * g / spring, 1e-12);
  EXPECT_NEAR(particle.velocity()[2], 0, 1e-12);
}

TEST(Wall, APenaltyThrowsBackWithItsRestitutionAndNeverPulls) {
  EXPECT_NEAR(damping_ratio(1), 0, 1e-9);
  EXPECT_EQ(damping_ratio(0), 1);
  const double spring = 2e4;
  const auto rebound = [&](double e) {
    FreeParticle<3> particle{
        {0, 0, 0.001}, {0, 0, -1}, density, {floor_with({ContactMethod::penalty, 0, e, spring})}};
    double fastest = -1;
    for (int i = 0; i < 4000; ++i) {
      particle.step(2e-5, Vec3::Zero());
      EXPECT_GE(particle.velocity()[2], fastest - 1e-15); // no pull
      fastest = particle.velocity()[2];
    }
    return fastest;
  };
  for (const double e : {0.2, 0.5, 0.9, 1.0})
    EXPECT_NEAR(rebound(e), e, 1e-3);
  EXPECT_NEAR(rebound(0), std::exp(-2), 1e-3);
}

TEST(Wall, AMovingToolTakesAParticleAlong) {
  for (const ContactMethod method : {ContactMethod::reflection, ContactMethod::penalty}) {
    const Vec3 velocity(3, 0, 2);
    FreeParticle<3> particle{{0, 0, 0.1}, {0, 0, 0}, density, {floor_with({method, 0, 0, 1e4}, velocity)}};
    double time = 0;
    for (int i = 0; i < 4000; ++i, time += 1e-4)
      particle.step(1e-4, Vec3::Zero());
    if (method == ContactMethod::reflection) {
      EXPECT_NEAR(particle.velocity()[2], 2, 1e-12);
      EXPECT_NEAR(particle.x[0][2], 2 * time, 1e-12);
    } else {
      EXPECT_NEAR(particle.velocity()[2], 2 * (1 + std::exp(-2)), 2e-3);
    }
    EXPECT_EQ(particle.velocity()[0], 0); // no friction
  }
}

TEST(Wall, FrictionOfAMovingToolDragsAParticleUpToItsSpeed) {
  const Vec3 velocity(1, 0, 0);
  FreeParticle<3> block{
      {0, 0, 0}, {0, 0, 0}, density, {floor_with({ContactMethod::reflection, 0.5, 0, 0}, velocity)}};
  block.step(0.1, Vec3(0, 0, -10));
  EXPECT_NEAR(block.velocity()[0], 0.5, 1e-14);
  for (int i = 0; i < 10; ++i)
    block.step(0.1, Vec3(0, 0, -10));
  EXPECT_NEAR(block.velocity()[0], 1, 1e-14);
}

TEST(Wall, ReportsForceFrictionPressureAndWhoWasTouched) {
  const double mu = 0.2, g = 10;
  std::vector<Wall<3>> walls = {
      {"floor", std::make_shared<Plane>(), {ContactMethod::reflection, mu, 0, 0}, Vec3::Zero(), 2}};
  std::vector<Vec3> x = {Vec3::Zero(), Vec3(0, 0, 1)}, p(2, Vec3(density, 0, 0)), impulse(2, Vec3::Zero());
  const std::vector<double> V = {0.5, 0.5}, area = {0.25, 0.25};
  const int steps = 3;
  for (int i = 0; i < steps; ++i) {
    p[0][2] -= density * g * dt;
    limit_by<3>(walls, x, p, density, i * dt, dt, 1, impulse);
  }
  const double weight = V[0] * density * g;
  const ContactReport<3> report = walls[0].report(V, area, steps * dt);
  EXPECT_LT((report.force - Vec3(-mu * weight, 0, weight)).norm(), 1e-13);
  EXPECT_LT((report.friction - Vec3(-mu * weight, 0, 0)).norm(), 1e-13);
  EXPECT_NEAR(report.largest_pressure, weight / area[0], 1e-12);
  EXPECT_EQ(report.touched, 1);
  const ContactReport<3> next = walls[0].report(V, area, dt);
  EXPECT_EQ(next.force, Vec3::Zero());
  EXPECT_EQ(next.touched, 0);
}
