/// The scheme "consistent" on the swinging cube, a standing pressure wave with a closed form: second order on
/// lattices, jittered lattices and two-pass clouds, where the thesis' scheme does not converge.
#include "preprocess/cloud/prepare.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/operators/support.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/swinging_cube.hpp"

#include <fmt/format.h>
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
    set.name = fmt::format("{}_{}", set.name[0], set.name.substr(1));
  return cloud;
}

/// Relative errors: of the velocity a quarter of the period on, where it is largest, and of the pressure an
/// eighth on, where it is large too.
struct Errors {
  double velocity, pressure;
};

using Change = std::function<void(SceneSpec&)>;

Errors errors(
    const preprocess::ParticleRequest& request, const Change& change = [](SceneSpec&) {}) {
  const ParticleCloud cloud = cube(request);
  SceneSpec scene = test::swinging_cube("consistent");
  change(scene);
  const Summary quarter = run(scene, cloud, {}, Progress::silent());
  scene.end_time = 0.002;
  const Summary eighth = run(scene, cloud, {}, Progress::silent());
  return {quarter.error->l2_velocity_relative, eighth.error->l2_pressure_relative};
}

/// Geometric means over three random clouds.
Errors over_seeds(int count) {
  Errors means{1, 1};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Errors one = errors(two_pass(count, 0, seed));
    means.velocity *= std::cbrt(one.velocity);
    means.pressure *= std::cbrt(one.pressure);
  }
  return means;
}

/// Where the spacing falls by `ratio`.
double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

} // namespace

TEST(SecondOrder, OnALattice) {
  const Errors coarse = errors(lattice(9)), middle = errors(lattice(17)), fine = errors(lattice(25));
  EXPECT_LT(middle.velocity, 0.0023);
  EXPECT_LT(fine.velocity, 0.0008);
  EXPECT_GT(order(coarse.velocity, middle.velocity, 2), 1.75);
  EXPECT_GT(order(coarse.velocity, fine.velocity, 3), 2);
  EXPECT_GT(order(coarse.pressure, fine.pressure, 3), 2);
}

TEST(SecondOrder, OnALatticeWithSymmetricJst) {
  const auto symmetric = [](SceneSpec& scene) { scene.dissipation = "jst_symmetric"; };
  const Errors coarse = errors(lattice(9), symmetric), fine = errors(lattice(17), symmetric);
  EXPECT_LT(fine.velocity, 0.0032);
  EXPECT_GT(order(coarse.velocity, fine.velocity, 2), 1.8);
}

TEST(SecondOrder, OnAJitteredLatticeWhereTheThesisDoesNotConverge) {
  const Errors coarse = errors(lattice(9, 0.3)), fine = errors(lattice(17, 0.3));
  EXPECT_LT(fine.velocity, 0.0075);
  EXPECT_GT(order(coarse.velocity, fine.velocity, 2), 1.65);
  EXPECT_GT(order(coarse.pressure, fine.pressure, 2), 0.85);
  EXPECT_GT(errors(lattice(9, 0.3), [](SceneSpec& scene) { scene.scheme = "thesis"; }).velocity, 0.2);
  const auto stronger = [](SceneSpec& scene) { scene.residual = PlasticRamp::constant(2); };
  EXPECT_LT(errors(lattice(25, 0.3), stronger).velocity, 0.003);
}

TEST(SecondOrder, OnRandomTwoPassClouds) {
  const Errors coarse = over_seeds(2250), fine = over_seeds(7000);
  EXPECT_LT(coarse.velocity, 0.039);
  EXPECT_LT(fine.velocity, 0.021);
  const double ratio = std::cbrt(7000. / 2250);
  EXPECT_GT(order(coarse.velocity, fine.velocity, ratio), 1.55);
  EXPECT_GT(order(coarse.pressure, fine.pressure, ratio), 1);
}

TEST(SecondOrder, OnRelaxedTwoPassClouds) {
  const Errors coarse = errors(two_pass(900, 20)), middle = errors(two_pass(2700, 20)),
               fine = errors(two_pass(8100, 20));
  EXPECT_LT(middle.velocity, 0.0105);
  EXPECT_LT(fine.velocity, 0.0042);
  EXPECT_GT(order(coarse.velocity, fine.velocity, std::cbrt(9)), 2);
  EXPECT_GT(order(coarse.pressure, fine.pressure, std::cbrt(9)), 1.7);
}

TEST(SecondOrder, OperatorsOfTwoPassCloudsBalanceAConstantStress) {
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = 1500;
  const ParticleCloud cloud = preprocess::prepare(test::l_domain(), request, Progress::silent()).cloud;
  const Neighbours graph = adaptive_support<3>(cloud.X, cloud.V, 30, cloud.hidden);
  Gradient<3> gradient = build_gradient<3>(cloud.X, cloud.V, graph);
  balance_constant_stress<3>(gradient, cloud.X, cloud.A, graph);
  double surface = 0;
  for (const Vec3& A : cloud.A)
    surface = std::max(surface, A.norm());
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    Vec3 force = Vec3::Zero();
    Mat3 slope = Mat3::Zero();
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      const std::int32_t b = graph.column[e];
      force += gradient.w(a, e, b) + gradient.t(a, e, b);
      slope += (cloud.X[b] - cloud.X[a]) * gradient.w(a, e, b).transpose();
    }
    ASSERT_LT((cloud.V[a] * force + cloud.A[a]).norm(), 1e-12 * surface) << a;
    ASSERT_LT((slope - Mat3::Identity()).norm(), 1e-11) << a;
  }
}
