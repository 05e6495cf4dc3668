#include "solver/scene/probe_values.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

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
