/// The scheme "consistent" on the swinging cube, a standing pressure wave with a closed form: second order on
/// lattices, jittered lattices and two-pass clouds, where the thesis' scheme does not converge.
#include "preprocess/cloud/prepare.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/operators/support.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/swinging_cube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

using namespace tessera;
using namespace tessera::solver;

namespace {

preprocess::ParticleRequest lattice(int points, double jitter = 0) {
  preprocess::ParticleRequest request;
  request.spacing = 1.0 / (points - 1);
  request.jitter = jitter;
  return request;
}

preprocess::ParticleRequest two_pass(int count, int relax, std::uint64_t seed = 1) {
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = count;
  request.relax_seeds = request.relax = relax;
  request.seed = seed;
  return request;
}

ParticleCloud cube(const preprocess::ParticleRequest& request) {
  ParticleCloud cloud = preprocess::prepare(test::box_domain(), request, Progress::silent()).cloud;
  for (ParticleSet& set : cloud.sets) // "xmin"
    set.name.insert(1, "_");
  return cloud;
}

/// At a time (s) of the swinging cube, with a change to the scene.
ErrorNorms errors(
    const ParticleCloud& cloud, double time,
    const std::function<void(SceneSpec&)>& change = [](SceneSpec&) {}) {
  SceneSpec scene = test::swinging_cube("consistent");
  scene.end_time = time;
  change(scene);
  return *run(scene, cloud, {}, Progress::silent()).error;
}

/// Of the velocity a quarter of the period on.
double velocity_error(
    const preprocess::ParticleRequest& request,
    const std::function<void(SceneSpec&)>& change = [](SceneSpec&) {}) {
  return errors(cube(request), 0.004, change).l2_velocity_relative;
}

/// Of the pressure an eighth of the period on.
double pressure_error(const preprocess::ParticleRequest& request) {
  return errors(cube(request), 0.002).l2_pressure_relative;
}

/// Geometric means over three clouds.
struct Means {
  double particles = 1, velocity = 1, pressure = 1;
};

Means over_seeds(int count) {
  Means means;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ParticleCloud cloud = cube(two_pass(count, 0, seed));
    means.particles *= std::cbrt(static_cast<double>(cloud.size()));
    means.velocity *= std::cbrt(errors(cloud, 0.004).l2_velocity_relative);
    means.pressure *= std::cbrt(errors(cloud, 0.002).l2_pressure_relative);
  }
  return means;
}

/// Of the spacing, for particles `ratio` times as many.
double order(double coarse, double fine, double ratio) {
  return 3 * std::log(coarse / fine) / std::log(ratio);
}

} // namespace

TEST(SecondOrder, OnALattice) {
  const double coarse = velocity_error(lattice(9)), middle = velocity_error(lattice(17)),
               fine = velocity_error(lattice(25));
  EXPECT_LT(middle, 0.0023);
  EXPECT_LT(fine, 0.0008);
  EXPECT_GT(std::log2(coarse / middle), 1.75);
  EXPECT_GT(std::log(coarse / fine) / std::log(3), 1.9);
  EXPECT_GT(std::log2(pressure_error(lattice(9)) / pressure_error(lattice(17))), 1.5);
}

TEST(SecondOrder, OnALatticeWithSymmetricJst) {
  const auto symmetric = [](SceneSpec& scene) { scene.dissipation = "jst_symmetric"; };
  const double coarse = velocity_error(lattice(9), symmetric), fine = velocity_error(lattice(17), symmetric);
  EXPECT_LT(fine, 0.0032);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

TEST(SecondOrder, OnAJitteredLatticeWhereTheThesisDoesNotConverge) {
  const double coarse = velocity_error(lattice(9, 0.3)), fine = velocity_error(lattice(17, 0.3));
  EXPECT_LT(fine, 0.0075);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
  EXPECT_GT(velocity_error(lattice(9, 0.3), [](SceneSpec& scene) { scene.scheme = "thesis"; }), 0.2);
  const auto stronger = [](SceneSpec& scene) { scene.residual = PlasticRamp::constant(2); };
  EXPECT_LT(velocity_error(lattice(25, 0.3), stronger), 0.003);
}

TEST(SecondOrder, OnRandomTwoPassClouds) {
  const Means coarse = over_seeds(700), middle = over_seeds(2250), fine = over_seeds(7000);
  EXPECT_LT(middle.velocity, 0.038);
  EXPECT_GT(order(coarse.velocity, fine.velocity, fine.particles / coarse.particles), 1.5);
  EXPECT_GT(order(coarse.pressure, fine.pressure, fine.particles / coarse.particles), 1);
}

TEST(SecondOrder, OnRelaxedTwoPassClouds) {
  const double coarse = velocity_error(two_pass(900, 20)), middle = velocity_error(two_pass(2700, 20)),
               fine = velocity_error(two_pass(8100, 20));
  EXPECT_LT(middle, 0.0105);
  EXPECT_GT(order(coarse, fine, 9), 1.7);
  EXPECT_GT(order(pressure_error(two_pass(900, 20)), pressure_error(two_pass(8100, 20)), 9), 1);
}

TEST(SecondOrder, OperatorsOfTwoPassCloudsBalanceAConstantStress) {
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = 1500;
  const ParticleCloud cloud = preprocess::prepare(test::l_domain(), request, Progress::silent()).cloud;
  const Neighbours graph = adaptive_support<3>(cloud.X, cloud.V, 30, cloud.hidden);
  Gradient<3> gradient = build_gradient<3>(cloud.X, cloud.V, graph);
  balance_constant_stress<3>(gradient, cloud.X, cloud.V, cloud.A, graph);
  double surface = 0;
  for (const Vec3& A : cloud.A)
    surface = std::max(surface, A.norm());
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    Vec3 force = gradient.s[a];
    Mat3 slope = -cloud.X[a] * gradient.s[a].transpose();
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      force += gradient.t[e];
      slope += cloud.X[graph.column[e]] * gradient.w[e].transpose();
    }
    ASSERT_LT((cloud.V[a] * force + cloud.A[a]).norm(), 1e-12 * surface) << a;
    ASSERT_LT((slope - Mat3::Identity()).norm(), 1e-11) << a;
  }
}
