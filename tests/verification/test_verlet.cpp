/// Verlet's step: momenta to round-off, energy without a drift, second order in time, tools not passed.
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

SceneSpec with_verlet(const std::string& formulation) {
  SceneSpec scene;
  scene.formulation = formulation;
  scene.scheme = "consistent";
  scene.integrator = "verlet";
  return scene;
}

SceneSpec spinning_cube(const std::string& formulation) {
  SceneSpec scene = with_verlet(formulation);
  scene.material = {"neo_hookean", 1100, 17e6, 0.45, std::nullopt};
  scene.initial.push_back(
      {"all", Formulas{Expression("-105*(Y-0.5)"), Expression("105*(X-0.5)"), Expression("20*X")}});
  scene.end_time = 0.5;
  scene.history_rows = 100;
  return scene;
}

using Rows = std::vector<std::vector<double>>;

Rows history(const SceneSpec& scene, const ParticleCloud& cloud) {
  Rows rows;
  Outputs outputs;
  outputs.history_row = [&](const std::vector<double>& row) { rows.push_back(row); };
  run(scene, cloud, outputs, Progress::silent());
  return rows;
}

/// A column that swings without dissipation, to the same time in steps of a given share of the critical one.
SceneSpec swinging_column(double share) {
  SceneSpec scene = with_verlet("pF");
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.residual = PlasticRamp::constant(0);
  scene.initial.push_back({"all", Formulas{Expression("0"), Expression("0.5*Z"), Expression("3*Z")}});
  scene.boundary.push_back({BoundaryCondition::Kind::fixed, "base"});
  scene.probes = {{"tip", "uz", "mean", "top"}};
  scene.end_time = 0.02;
  scene.cfl = share;
  return scene;
}

ParticleCloud column() {
  return test::box_lattice(5, 5, 9, Vec3(0.5, 0.5, 1));
}

} // namespace

TEST(Verlet, KeepsMomentaInEveryFormulation) {
  for (const char* formulation : {"displacement", "pF", "pFJ", "pFHJ"}) {
    SceneSpec scene = spinning_cube(formulation);
    scene.residual = PlasticRamp::constant(1);
    const Rows rows = history(scene, test::box_lattice(5, 5, 5, Vec3(1, 1, 1)));
    const Vec3 linear(rows[0][10], rows[0][11], rows[0][12]), angular(rows[0][13], rows[0][14], rows[0][15]);
    for (const auto& row : rows) {
      EXPECT_LT((Vec3(row[10], row[11], row[12]) - linear).norm(), 1e-12 * angular.norm()) << formulation;
      EXPECT_LT((Vec3(row[13], row[14], row[15]) - angular).norm(), 1e-12 * angular.norm()) << formulation;
    }
    EXPECT_LE(rows.back()[3] + rows.back()[4], rows[0][3] + rows[0][4]) << formulation;
  }
}

TEST(Verlet, EnergyDoesNotDriftWithoutDissipation) {
  // Heun's method amplifies; Verlet's errors come and go with the waves.
  SceneSpec scene = spinning_cube("pF");
  scene.residual = PlasticRamp::constant(0);
  const Rows rows = history(scene, test::box_lattice(5, 5, 5, Vec3(1, 1, 1)));
  double early = 0, late = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    (i < rows.size() / 2 ? early : late) =
        std::max(i < rows.size() / 2 ? early : late, std::abs(rows[i][8] - rows[0][8]));
  EXPECT_LT(early, 1e-2 * rows[0][8]);
  EXPECT_LT(late, 1.5 * early);
}

TEST(Verlet, IsOfSecondOrderInTime) {
  const auto tip = [&](double share) {
    return run(swinging_column(share), column(), {}, Progress::silent()).probes.front().second;
  };
  const double coarse = tip(0.2), middle = tip(0.1), fine = tip(0.05);
  EXPECT_NEAR(std::log2(std::abs((coarse - middle) / (middle - fine))), 2, 0.2);
}

TEST(Verlet, LedgerBalancesToSecondOrder) {
  const auto imbalance = [&](double share) {
    return run(swinging_column(share), column(), {}, Progress::silent()).energy.balance_error;
  };
  const double coarse = imbalance(0.4), fine = imbalance(0.2);
  EXPECT_LT(coarse, 5e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

TEST(Verlet, PlasticImpactBalancesWithTheStepAndDoesNotPassTheWall) {
  for (const ContactMethod method : {ContactMethod::reflection, ContactMethod::penalty}) {
    SceneSpec scene = with_verlet("pF");
    scene.material = {"hencky", 8930, 117e9, 0.35, LinearHardening{0.4e9, 0.1e9}};
    scene.initial.push_back({"all", Formulas{Expression("0"), Expression("0"), Expression("-227")}});
    scene.walls.push_back({});
    scene.walls.back().method = method;
    scene.end_time = 3e-6;
    const double h = 0.64e-3;
    const auto cloud = test::cylinder_lattice(3, 11, h);
    scene.scheme = "thesis"; // the cylinder of cubes has no areas to balance
    scene.cfl = 0.4;
    const double coarse = run(scene, cloud, {}, Progress::silent()).energy.balance_error;
    scene.cfl = 0.2;
    const Summary fine = run(scene, cloud, {}, Progress::silent());
    EXPECT_LT(coarse, 5e-3);
    EXPECT_LT(fine.energy.balance_error, coarse / 3);
    EXPECT_GT(fine.extent_min[2], method == ContactMethod::reflection ? -1e-12 : -0.1 * h);
    EXPECT_GT(fine.energy.plastic, 0.1 * fine.energy.kinetic);
  }
}
