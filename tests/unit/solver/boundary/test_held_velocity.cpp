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
  return {{{particle, std::move(directions)}}, {}};
}

} // namespace

TEST(HeldVelocities, HoldsTheNamedDirectionsOfItsSetOnly) {
  const After after({{{{0, {Vec3::UnitX(), Vec3::UnitZ()}}, {2, {Vec3::UnitX(), Vec3::UnitZ()}}}, {}}});
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
