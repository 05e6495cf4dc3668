#include "solver/scene/probe_values.hpp"

#include "core/error.hpp"

#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <numbers>

using namespace tessera;
using namespace tessera::solver;

namespace {

struct TwoParticles {
  ParticleCloud cloud;
  std::vector<double> u = {0, 0, 0, 3, 4, -1}, v = {1, 0, 0, 2, 0, 0}, eps = {0.5, 0.25}, mises = {1e6, 3e6},
                      pr = {-1, 1}, J = {1, 1};

  TwoParticles() {
    cloud.X = {Vec3(1, 0, 0), Vec3(0, 0, 5)};
    cloud.sets = {{"top", {1}, {}}};
  }
  double read(const std::string& quantity, const std::string& reduce, const std::string& on = "all") const {
    return ProbeReader({"p", quantity, reduce, on}, cloud).read({cloud.X, u, v, eps, mises, pr, J});
  }
};

} // namespace

TEST(Probe, ReadsCurrentPositionsAndReducesThem) {
  const TwoParticles two;
  EXPECT_EQ(two.read("radius", "max"), 5);
  EXPECT_EQ(two.read("radius", "min"), 1);
  EXPECT_EQ(two.read("z", "extent"), 4);
  EXPECT_EQ(two.read("vx", "mean"), 1.5);
  EXPECT_EQ(two.read("uy", "mean", "top"), 4);
  EXPECT_EQ(two.read("plastic_strain", "max"), 0.5);
  EXPECT_EQ(two.read("von_mises", "max", "top"), 3e6);
  EXPECT_EQ(two.read("pressure", "min"), -1);
}

TEST(Probe, ColumnsCarryTheirUnit) {
  EXPECT_EQ(column_name({"tip", "uz", "max", "all"}), "tip_m");
  EXPECT_EQ(column_name({"speed", "vx", "max", "all"}), "speed_m_s");
  EXPECT_EQ(column_name({"peak", "von_mises", "max", "all"}), "peak_Pa");
  EXPECT_EQ(column_name({"eps", "plastic_strain", "max", "all"}), "eps");
}

TEST(Probe, AnUnknownSetIsAnError) {
  EXPECT_THROW(TwoParticles().read("z", "max", "tpo"), InputError);
}

TEST(Probe, AnglesGoBeyondFullTurns) {
  ParticleCloud cloud;
  cloud.X = {Vec3(2, 0, 0), Vec3(0, 1, 0)};
  const std::vector<double> zeros(6, 0.0), zero(2, 0.0), one(2, 1.0);
  ProbeReader reader({"tip", "angle", "mean", "all", {}, Vec3(0.5, 0, 0)}, cloud);
  const auto read = [&](double degrees) {
    std::vector<double> u;
    const Mat3 Q = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitZ()).toRotationMatrix();
    for (const Vec3& X : cloud.X) {
      const Vec3 moved = Q * (X - Vec3(0.5, 0, 0)) + Vec3(0.5, 0, 0) - X;
      u.insert(u.end(), moved.begin(), moved.end());
    }
    return reader.read({cloud.X, u, zeros, zero, zero, zero, one});
  };
  for (const double angle : {100.0, 250.0, 400.0, 520.0, 390.0, 215.0, 40.0, -130.0, -300.0, -440.0})
    EXPECT_NEAR(read(angle), angle, 1e-9);
}

TEST(Probe, APointIsInterpolatedFromParticlesAroundIt) {
  const auto cloud = test::box_lattice(5, 5, 5, Vec3(1, 1, 1));
  std::vector<double> u, pressure;
  for (const Vec3& X : cloud.X) {
    u.insert(u.end(), {0.1 * X[0], 0, -0.2 * X[1]});
    pressure.push_back(3 * X[2] - 1);
  }
  const std::vector<double> zero(pressure.size(), 0.0);
  const Vec3 at(0.41, 0.23, 0.77);
  const auto read = [&](const std::string& quantity) {
    return ProbeReader({"p", quantity, "", "", at}, cloud).read({cloud.X, u, u, zero, zero, pressure, zero});
  };
  EXPECT_NEAR(read("pressure"), 3 * 0.77 - 1, 1e-12);
  EXPECT_NEAR(read("x"), 0.41 * 1.1, 1e-12);
  EXPECT_NEAR(read("uz"), -0.2 * 0.23, 1e-12);
  EXPECT_THROW(ProbeReader({"p", "x", "", "", Vec3(5, 5, 5)}, cloud), InputError);
}
