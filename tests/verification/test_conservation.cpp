/// A free spinning cube: what must stay constant does, to round-off.
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

SceneSpec spinning_cube() {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.initial.push_back(
      {"all", Formulas{Expression("-105*(Y-0.5)"), Expression("105*(X-0.5)"), Expression("0")}});
  scene.end_time = 1;
  scene.history_rows = 100;
  return scene;
}

struct Worst {
  double linear = 0, angular = 0, first_energy = 0, last_energy = 0, first_angular = 0, last_angular = 0;
};

Worst spin(const SceneSpec& scene) {
  const auto cloud = test::box_lattice(6, 6, 6, Vec3(1, 1, 1));
  Worst worst;
  Vec3 linear_start, angular_start;
  bool first = true;
  // Speeds are up to 105 * 0.7 m/s: sum V |p| is the scale of linear momentum, the angular one has its own.
  Outputs outputs;
  outputs.history_row = [&](const std::vector<double>& row) {
    const Vec3 linear(row[10], row[11], row[12]), angular(row[13], row[14], row[15]);
    if (first) {
      linear_start = linear;
      angular_start = angular;
      worst.first_energy = row[3] + row[4];
      worst.first_angular = angular[2];
    }
    first = false;
    worst.linear = std::max(worst.linear, (linear - linear_start).norm() / angular_start.norm());
    worst.angular = std::max(worst.angular, (angular - angular_start).norm() / angular_start.norm());
    worst.last_energy = row[3] + row[4];
    worst.last_angular = angular[2];
  };
  run(scene, cloud, outputs, Progress::silent());
  return worst;
}

} // namespace

TEST(SpinningCube, KeepsLinearAndAngularMomentumForASecond) {
  const Worst worst = spin(spinning_cube());
  EXPECT_LT(worst.linear, 1e-12);
  EXPECT_LT(worst.angular, 1e-12);
  // Dissipation may only take energy.
  EXPECT_LE(worst.last_energy, worst.first_energy);
}

TEST(SpinningCube, LosesAngularMomentumWithoutTheProjection) {
  SceneSpec scene = spinning_cube();
  scene.momentum_projection = false;
  const Worst worst = spin(scene);
  EXPECT_LT(worst.last_angular, 0.9 * worst.first_angular);
}

TEST(SpinningCube, GainsEnergyWithoutDissipation) {
  SceneSpec scene = spinning_cube();
  scene.jst4 = Kappa4::constant(0);
  const Worst worst = spin(scene);
  EXPECT_GT(worst.last_energy, worst.first_energy);
  EXPECT_LT(worst.angular, 1e-12);
}
