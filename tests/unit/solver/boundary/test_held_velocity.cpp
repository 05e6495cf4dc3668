#include "solver/boundary/held_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double density = 2;
const std::vector<Vec3> X = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 3, 0)};

/// Momenta (1, 2, 3) of three particles after the conditions, and the impulse they note.
struct After {
  std::vector<Vec3> p = std::vector<Vec3>(3, Vec3(1, 2, 3)), impulse = std::vector<Vec3>(3, Vec3::Zero());

  explicit After(const std::vector<VelocityCondition<3>>& conditions, double time = 0, double share = 1) {
    HeldVelocities<3>(conditions, X).apply(p, density, time, share, impulse);
  }
};

VelocityCondition<3> along(std::int32_t particle, std::vector<Vec3> directions) {
  return {{{particle, std::move(directions)}}, {}, "support"};
}

} // namespace

TEST(HeldVelocities, HoldsTheNamedDirectionsOfItsSetOnly) {
  const After after(
      {{{{0, {Vec3::UnitX(), Vec3::UnitZ()}}, {2, {Vec3::UnitX(), Vec3::UnitZ()}}}, {}, "support"}});
  EXPECT_EQ(after.p[0], Vec3(0, 2, 0));
  EXPECT_EQ(after.p[1], Vec3(1, 2, 3));
  EXPECT_EQ(after.p[2], Vec3(0, 2, 0));
  EXPECT_EQ(after.impulse[0], Vec3::Zero());
}

TEST(HeldVelocities, TakesTheNormalPartOnALeaningSurface) {
  const Vec3 n = Vec3(1, 1, 0).normalized();
  const After after({along(1, {n})});
  EXPECT_NEAR(after.p[1].dot(n), 0, 1e-15);
  EXPECT_NEAR((after.p[1] - Vec3(-0.5, 0.5, 3)).norm(), 0, 1e-15);
}

TEST(HeldVelocities, BothConditionsHoldOnAnEdgeWhateverTheAngle) {
  const Vec3 n = Vec3::UnitX(), m = Vec3(1, 0.3, 0).normalized();
  const After after({along(0, {n}), along(0, {m})});
  EXPECT_NEAR((after.p[0] - Vec3(0, 0, 3)).norm(), 0, 1e-14);
}

TEST(HeldVelocities, MoveAsTheFormulaSaysAtThePlaceAndTime) {
  VelocityCondition<3> moving = along(2, {Vec3::UnitY()});
  moving.velocity = GivenVector{[](const Vec3& at, double t) { return Vec3(9, at[1] * t, 9); }, false};
  const After after({moving}, 0.5, 0.25);
  EXPECT_EQ(after.p[2], Vec3(1, density * 1.5, 3));
  EXPECT_EQ(after.impulse[2], Vec3(0, 0.25 * (3 - 2), 0));
}

TEST(HeldVelocities, AMovingSurfaceMeetsAStillOneAtAnEdge) {
  // n . v = 0 and m . v = m . w, with n and m not perpendicular.
  const Vec3 n = Vec3::UnitX(), m = Vec3(0.6, 0.8, 0), w(1, 2, 0);
  VelocityCondition<3> moving = along(0, {m});
  moving.velocity = GivenVector{[&](const Vec3&, double) { return w; }, true};
  for (const auto& conditions : {std::vector{along(0, {n}), moving}, std::vector{moving, along(0, {n})}}) {
    const After after(conditions);
    EXPECT_NEAR(after.p[0].dot(n), 0, 1e-14);
    EXPECT_NEAR(after.p[0].dot(m) / density, m.dot(w), 1e-14);
    EXPECT_EQ(after.p[0][2], 3);
  }
}

TEST(HeldVelocities, TheLaterOfTwoContradictingConditionsWins) {
  VelocityCondition<3> moving = along(0, {Vec3::UnitX()});
  moving.velocity = GivenVector{[](const Vec3&, double) { return Vec3(5, 0, 0); }, true};
  EXPECT_EQ(After({along(0, {Vec3::UnitX()}), moving}).p[0][0], 5 * density);
  EXPECT_EQ(After({moving, along(0, {Vec3::UnitX()})}).p[0][0], 0);
}

TEST(HeldVelocities, FullyHeldParticlesStandStill) {
  const After after({along(1, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()})});
  EXPECT_EQ(after.p[1], Vec3::Zero());
}

TEST(HeldVelocities, ReportTheForceOfEachSupportOnceWithTheLaterOneFirst) {
  VelocityCondition<3> base = along(0, {Vec3::UnitX(), Vec3::UnitY()});
  base.support = "base";
  base.held.push_back({2, {Vec3::UnitZ()}});
  VelocityCondition<3> side = along(0, {Vec3::UnitY()});
  side.support = "side";
  side.velocity = GivenVector{[](const Vec3&, double) { return Vec3(0, 4, 0); }, true};
  HeldVelocities<3> held(std::vector{base, side}, X);
  EXPECT_EQ(held.supports(), (std::vector<std::string>{"base", "side"}));
  const std::vector<double> V = {10, 1, 100};
  std::vector<Vec3> p(3, Vec3(1, 2, 3)), impulse(3, Vec3::Zero());
  held.apply(p, density, 0, 0.5, impulse);
  p = std::vector<Vec3>(3, Vec3(1, 2, 3));
  held.apply(p, density, 0, 0.5, impulse);
  const double elapsed = 0.25;
  const auto reactions = held.report(V, elapsed);
  ASSERT_EQ(reactions.size(), 2u);
  EXPECT_EQ(reactions[0].support, "base");
  EXPECT_EQ(reactions[0].force, Vec3(-1 * 10, 0, -3 * 100) / elapsed);
  EXPECT_EQ(reactions[1].support, "side");
  EXPECT_EQ(reactions[1].force, Vec3(0, (4 * density - 2) * 10, 0) / elapsed);
  for (const auto& reaction : held.report(V, elapsed))
    EXPECT_EQ(reaction.force, Vec3::Zero());
}
