#include "solver/boundary/loads.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// A box of 2 x 1 x 1.5 m under a homogeneous deformation.
struct Box {
  ParticleCloud cloud = test::box_lattice(5, 4, 6, Vec3(2, 1, 1.5));
  std::vector<Mat3> F = std::vector<Mat3>(cloud.X.size(), Mat3::Identity());

  std::vector<Vec3> force(const Load<3>& load, double time = 0) const {
    std::vector<Vec3> f(cloud.X.size(), Vec3::Zero());
    load.add({cloud.X, cloud.V, 1100, {F, {}, {}}, time}, f);
    return f;
  }
  Vec3 total(const Load<3>& load, double time = 0) const {
    Vec3 sum = Vec3::Zero();
    const auto f = force(load, time);
    for (std::size_t a = 0; a < f.size(); ++a)
      sum += cloud.V[a] * f[a];
    return sum;
  }
  std::vector<double> areas(const ParticleSet& set) const {
    std::vector<double> area;
    for (const Vec3& A : set.area)
      area.push_back(A.norm());
    return area;
  }
};

GivenVector constant(const Vec3& v) {
  return {[v](const Vec3&, double) { return v; }, true};
}

} // namespace

TEST(Traction, AddsUpToTheTractionTimesTheSurface) {
  const Box box;
  const ParticleSet& face = box.cloud.set("x_max");
  const Traction<3> load(face.particles, box.areas(face), constant(Vec3(1e5, -2e4, 3e3)));
  EXPECT_LT((box.total(load) - 1.5 * Vec3(1e5, -2e4, 3e3)).norm(), 1e-9 * 1e5);
}

TEST(Traction, FollowsItsFormulaInPlaceAndTime) {
  const Box box;
  const ParticleSet& face = box.cloud.set("z_max");
  const Traction<3> load(face.particles, box.areas(face),
                         {[](const Vec3& X, double t) { return Vec3(0, 0, t * X[0]); }, false});
  // The integral of 3 x over 2 x 1 m: the trapezoidal rule of half cells is exact for it.
  EXPECT_NEAR(box.total(load, 3)[2], 6, 1e-12);
  EXPECT_EQ(box.total(load, 0)[2], 0);
}

TEST(FollowingPressure, TurnsAndGrowsWithTheSurface) {
  Box box;
  const Mat3 Q = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Mat3 stretch = Vec3(1.2, 0.8, 1.1).asDiagonal();
  box.F.assign(box.F.size(), Q * stretch);
  const ParticleSet& face = box.cloud.set("x_max");
  const FollowingPressure<3> load(face.particles, face.area, constant(Vec3(2e5, 0, 0)));
  const Vec3 expected = -2e5 * 1.5 * (0.8 * 1.1) * (Q * Vec3::UnitX());
  EXPECT_LT((box.total(load) - expected).norm(), 1e-9 * expected.norm());
}

TEST(FollowingPressure, OfEqualSizeAllAroundMovesNothing) {
  Box box;
  Mat3 F;
  F << 1.1, 0.2, 0, -0.1, 0.9, 0.3, 0, 0.1, 1.2;
  box.F.assign(box.F.size(), F);
  Vec3 total = Vec3::Zero();
  for (const char* name : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}) {
    const ParticleSet& face = box.cloud.set(name);
    total += box.total(FollowingPressure<3>(face.particles, face.area, constant(Vec3(1e6, 0, 0))));
  }
  EXPECT_LT(total.norm(), 1e-9 * 1e6);
}

TEST(BodyForce, IsTheWeight) {
  const Box box;
  std::vector<std::int32_t> all;
  for (std::size_t a = 0; a < box.cloud.X.size(); ++a)
    all.push_back(static_cast<std::int32_t>(a));
  const Vec3 weight = box.total(BodyForce<3>(all, constant(Vec3(0, 0, -9.81))));
  EXPECT_NEAR(weight[2], -9.81 * 1100 * 3, 1e-8);
  EXPECT_EQ(weight[0], 0);
}
