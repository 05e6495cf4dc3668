#include "solver/scene/conditions.hpp"

#include "core/error.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

using Kind = BoundaryCondition::Kind;

/// Momenta (1, 2, 3) of every particle after the held velocities of these entries.
std::vector<Vec3> held(const ParticleCloud& cloud, std::vector<BoundaryCondition> boundary, double time = 0) {
  SceneSpec scene;
  scene.boundary = std::move(boundary);
  Conditions<3> conditions = make_conditions<3>(scene, cloud, 1, 1);
  std::vector<Vec3> p(cloud.X.size(), Vec3(1, 2, 3)), impulse(p.size(), Vec3::Zero());
  conditions.held.apply(p, 1, time, 1, impulse);
  return p;
}

std::int32_t particle_at(const ParticleCloud& cloud, const Vec3& X) {
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    if ((cloud.X[a] - X).norm() < 1e-9)
      return static_cast<std::int32_t>(a);
  ADD_FAILURE() << "no particle there";
  return 0;
}

} // namespace

TEST(Conditions, SlidingAndSkewSymmetricFacesShareTheirEdges) {
  const auto cloud = test::box_lattice(3, 3, 3, Vec3(1, 1, 1));
  const auto p = held(cloud, {{Kind::sliding, "x_min"}, {Kind::skew_symmetric, "y_max"}});
  EXPECT_LT((p[particle_at(cloud, Vec3(0, 0.5, 0.5))] - Vec3(0, 2, 3)).norm(), 1e-14);
  EXPECT_LT((p[particle_at(cloud, Vec3(0.5, 1, 0.5))] - Vec3(0, 2, 0)).norm(), 1e-14);
  EXPECT_LT((p[particle_at(cloud, Vec3(0, 1, 0.5))] - Vec3(0, 2, 0)).norm(), 1e-14);
  EXPECT_EQ(p[particle_at(cloud, Vec3(0.5, 0.5, 0.5))], Vec3(1, 2, 3));
}

TEST(Conditions, SlidingOnACurvedFaceUsesEachParticlesOwnNormal) {
  auto cloud = test::box_lattice(3, 3, 3, Vec3(1, 1, 1));
  ParticleSet round{"round", {}, {}};
  for (const Vec3& at : {Vec3(1, 0.5, 0.5), Vec3(0.5, 1, 0.5), Vec3(1, 1, 0.5)}) {
    round.particles.push_back(particle_at(cloud, at));
    round.area.push_back(0.1 * (at - Vec3(0.5, 0.5, 0.5)));
  }
  cloud.sets.push_back(round);
  const auto p = held(cloud, {{Kind::sliding, "round"}});
  EXPECT_LT((p[round.particles[0]] - Vec3(0, 2, 3)).norm(), 1e-14);
  EXPECT_LT((p[round.particles[1]] - Vec3(1, 0, 3)).norm(), 1e-14);
  EXPECT_LT((p[round.particles[2]] - Vec3(-0.5, 0.5, 3)).norm(), 1e-14);
}

TEST(Conditions, MovingBoundariesRampWithTime) {
  const auto cloud = test::box_lattice(3, 3, 3, Vec3(1, 1, 1));
  BoundaryCondition punch{Kind::velocity, "z_max", {false, false, true}};
  punch.values = {Expression("0"), Expression("0"), Expression("-10*min(t/0.1, 1)")};
  const std::int32_t a = particle_at(cloud, Vec3(0.5, 0.5, 1));
  EXPECT_EQ(held(cloud, {punch}, 0.05)[a], Vec3(1, 2, -5));
  EXPECT_EQ(held(cloud, {punch}, 1)[a], Vec3(1, 2, -10));
}

TEST(Conditions, ASetWithoutSurfaceHasNothingToSlideOn) {
  auto cloud = test::box_lattice(3, 3, 3, Vec3(1, 1, 1));
  cloud.sets.push_back({"inner", {13}, {Vec3::Zero()}});
  try {
    held(cloud, {{Kind::sliding, "inner"}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("'inner'"), std::string::npos);
  }
}

TEST(Conditions, InitialDisplacementsMoveTheirSetOnly) {
  const auto cloud = test::box_lattice(3, 3, 3, Vec3(1, 1, 1));
  SceneSpec scene;
  EXPECT_TRUE(initial_positions<3>(scene, cloud).empty());
  scene.initial.push_back({"x_max", {}, Formulas{Expression("0.1*X"), Expression("0"), Expression("0")}});
  const auto x = initial_positions<3>(scene, cloud);
  EXPECT_EQ(x[particle_at(cloud, Vec3(1, 0, 0))], Vec3(1.1, 0, 0));
  EXPECT_EQ(x[particle_at(cloud, Vec3(0.5, 0, 0))], Vec3(0.5, 0, 0));
}

TEST(Conditions, StrainsBeginWithTheSlopeOfTheFormulaThatDisplacesAll) {
  const auto cloud = test::box_lattice(3, 3, 3, Vec3(1, 1, 1));
  SceneSpec scene;
  scene.scheme = "consistent";
  EXPECT_TRUE(initial_gradients<3>(scene, cloud).empty());
  scene.initial.push_back(
      {"all", {}, Formulas{Expression("0.1*sin(X)*Y"), Expression("0.2*Z^3"), Expression("0")}});
  const auto F = initial_gradients<3>(scene, cloud);
  const std::int32_t a = particle_at(cloud, Vec3(1, 0.5, 1));
  Mat3 expected = Mat3::Identity();
  expected(0, 0) += 0.05 * std::cos(1);
  expected(0, 1) = 0.1 * std::sin(1);
  expected(1, 2) = 0.6;
  EXPECT_LT((F.at(a) - expected).norm(), 1e-12);
  scene.scheme = "thesis";
  EXPECT_TRUE(initial_gradients<3>(scene, cloud).empty());
  scene.scheme = "consistent";
  scene.initial.push_back({"x_max", {}, Formulas{Expression("0.1*X"), Expression("0"), Expression("0")}});
  EXPECT_TRUE(initial_gradients<3>(scene, cloud).empty());
  scene.initial.back() = {"all", {}, Formulas{Expression("sqrt(X)"), Expression("0"), Expression("0")}};
  EXPECT_TRUE(initial_gradients<3>(scene, cloud).empty());
}
