/// What the ledger of energies leaves unaccounted for is the error of the time integration alone: it vanishes
/// with the step.
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// Largest balance error of a run.
double balance_error(SceneSpec scene, const ParticleCloud& cloud, double cfl) {
  scene.cfl = cfl;
  double worst = 0;
  Outputs outputs;
  outputs.history_row = [&](const std::vector<double>& row) { worst = std::max(worst, row[9]); };
  run(scene, cloud, outputs, Progress::silent());
  return worst;
}

} // namespace

TEST(EnergyBalance, OfAnElasticBodyIsOfThirdOrderInTheStep) {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.jst4 = Kappa4::constant(0);
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.initial.push_back({"all", Formulas{Expression("0"), Expression("0.5*Z"), Expression("3*Z")}});
  scene.boundary.push_back({BoundaryCondition::Kind::fixed, "base"});
  scene.end_time = 0.02;
  const auto cloud = test::box_lattice(5, 5, 9, Vec3(0.5, 0.5, 1));
  // Heun's method amplifies an oscillation by 1 + (omega dt)^4 / 8 a step, which is third order over a given
  // time.
  const double coarse = balance_error(scene, cloud, 0.1), fine = balance_error(scene, cloud, 0.05);
  EXPECT_LT(coarse, 2e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 3, 0.15);
}

TEST(EnergyBalance, OfAPlasticImpactConvergesWithTheStep) {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"hencky", 8930, 117e9, 0.35, LinearHardening{0.4e9, 0.1e9}};
  scene.jst4 = Kappa4::constant(1.0 / 4096);
  scene.initial.push_back({"all", Formulas{Expression("0"), Expression("0"), Expression("-227")}});
  scene.walls.push_back({});
  scene.end_time = 3e-6;
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  const double coarse = balance_error(scene, cloud, 0.3), fine = balance_error(scene, cloud, 0.15);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, coarse / 3);
}

TEST(EnergyBalance, HoldsWhereJAndHAreDissipatedAndTiedToF) {
  // What the dissipation and the penalty do to J and H is booked: without that some per cent would be
  // missing, whatever the step.
  for (const char* formulation : {"pFJ", "pFHJ"})
    for (const char* integrator : {"heun", "verlet"}) {
      SceneSpec scene;
      scene.formulation = formulation;
      scene.integrator = integrator;
      scene.scheme = "thesis";
      scene.dissipation = "linear_residual";
      scene.residual_J = 1;
      scene.involution = 0.5;
      scene.material = {"neo_hookean", 1100, 17e6, 0.45, std::nullopt};
      scene.initial.push_back(
          {"all", Formulas{Expression("-60*Z*(Y-0.25)"), Expression("60*Z*(X-0.25)"), Expression("0")}});
      scene.boundary.push_back({BoundaryCondition::Kind::fixed, "base"});
      scene.end_time = 0.02;
      const auto cloud = test::box_lattice(4, 4, 8, Vec3(0.5, 0.5, 1));
      const double coarse = balance_error(scene, cloud, 0.1), fine = balance_error(scene, cloud, 0.05);
      EXPECT_LT(coarse, 1e-3) << formulation << ' ' << integrator;
      EXPECT_LT(fine, coarse / 2.2) << formulation << ' ' << integrator;
    }
}
