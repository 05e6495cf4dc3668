/// What the formulations make of the same scene, and how they converge to a closed form.
#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/swinging_cube.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace tessera;
using namespace tessera::solver;

namespace {

using Kind = BoundaryCondition::Kind;

ErrorNorms errors(const SceneSpec& scene, int n) {
  return *run(scene, test::box_lattice(n, n, n, Vec3(1, 1, 1)), {}, Progress::silent()).error;
}

} // namespace

TEST(SwingingCube, TheSchemeIsOfFirstOrderOnLattices) {
  // An independent program gave 13.5 and 7.8 per cent.
  const double coarse = errors(test::swinging_cube("thesis"), 9).l2_velocity_relative,
               fine = errors(test::swinging_cube("thesis"), 17).l2_velocity_relative;
  EXPECT_NEAR(coarse, 0.136, 0.002);
  EXPECT_NEAR(fine, 0.0803, 0.002);
}

TEST(SwingingCube, TheFormulationsAgreeWhereStrainsAreSmall) {
  SceneSpec scene = test::swinging_cube("thesis");
  scene.formulation = "pF";
  const ErrorNorms pF = errors(scene, 9);
  for (const char* formulation : {"pFJ", "pFHJ"}) {
    scene.formulation = formulation;
    const ErrorNorms other = errors(scene, 9);
    EXPECT_NEAR(other.l2_velocity / pF.l2_velocity, 1, 0.002) << formulation;
    EXPECT_NEAR(other.l1_pressure / pF.l1_pressure, 1, 0.002) << formulation;
  }
}

TEST(Displacement, IsTheFibreMapsFormulationWithoutDissipation) {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"neo_hookean", 1100, 17e6, 0.45, std::nullopt};
  scene.initial.push_back({"all", Formulas{Expression("0"), Expression("8*Z"), Expression("0")}});
  scene.boundary.push_back({Kind::fixed, "base"});
  scene.probes = {{"tip", "uy", "mean", "top"}};
  scene.end_time = 0.02;
  const auto cloud = test::box_lattice(4, 4, 7, Vec3(0.5, 0.5, 1));
  scene.formulation = "displacement";
  const Summary x = run(scene, cloud, {}, Progress::silent());
  scene.formulation = "pF";
  scene.jst4 = Kappa4::constant(0);
  const Summary F = run(scene, cloud, {}, Progress::silent());
  EXPECT_EQ(x.formulation, "displacement");
  EXPECT_GT(x.probes[0].second, 0.05);
  EXPECT_NEAR(x.probes[0].second / F.probes[0].second, 1, 1e-10);
  EXPECT_EQ(x.steps, F.steps);
  EXPECT_LT(x.bytes_per_particle, F.bytes_per_particle);
}

TEST(Involution, KeepsAVolumeMapThatItsDissipationWouldDriveAway) {
  // A column twisted by more than a full turn.
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"neo_hookean", 1100, 17e6, 0.45, std::nullopt};
  scene.formulation = "pFJ";
  scene.initial.push_back({"all", Formulas{Expression("-105*sin(_pi*Z/12)*(Y-0.5)"),
                                           Expression("105*sin(_pi*Z/12)*(X-0.5)"), Expression("0")}});
  scene.boundary.push_back({Kind::fixed, "base"});
  scene.end_time = 0.1;
  const auto cloud = test::box_lattice(6, 6, 31, Vec3(1, 1, 6));
  scene.involution = 0.2;
  const Summary tied = run(scene, cloud, {}, Progress::silent());
  EXPECT_GT(tied.extremes.jacobian, 0.85);
  EXPECT_LT(tied.energy.balance_error, 0.01);
  scene.involution = 0;
  EXPECT_THROW(run(scene, cloud, {}, Progress::silent()), RunError);
}

TEST(Loads, AFreeBodyFallsWithoutStrain) {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.boundary.push_back(
      {Kind::body_force, "all", {true, true, true}, {Expression("0"), Expression("0"), Expression("-9.81")}});
  scene.probes = {{"lowest", "uz", "min", "all"}, {"highest", "uz", "max", "all"}};
  scene.end_time = 0.1;
  const Summary summary = run(scene, test::box_lattice(4, 5, 4, Vec3(1, 1, 1)), {}, Progress::silent());
  for (const auto& [name, fall] : summary.probes)
    EXPECT_NEAR(fall / (-0.5 * 9.81 * 0.01), 1, 1e-12) << name;
  EXPECT_LT(summary.energy.internal, 1e-12 * summary.energy.kinetic);
  EXPECT_NEAR(summary.energy.external / summary.energy.kinetic, 1, 1e-12);
  EXPECT_LT(summary.energy.balance_error, 1e-12);
}

TEST(Loads, ASuddenTractionStretchesABarTwiceAsFarAsASlowOne) {
  // A bar without Poisson's ratio: the tip goes to 2 t L / E and back in 4 L / c.
  const double L = 1, young = 1e7, density = 1000, traction = 1e4, c = std::sqrt(young / density);
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"linear_elastic", density, young, 0, std::nullopt};
  scene.boundary.push_back({Kind::fixed, "base"});
  scene.boundary.push_back({Kind::traction,
                            "top",
                            {true, true, true},
                            {Expression("0"), Expression(std::to_string(traction)), Expression("0")}});
  scene.probes = {{"tip", "uy", "mean", "top"}};
  scene.end_time = 2 * L / c;
  const auto tip = [&](int layers) {
    const auto cloud = test::box_lattice(4, layers, 1, Vec3(3 * L / (layers - 1), L, 0));
    const Summary summary = run(scene, cloud, {}, Progress::silent());
    EXPECT_LT(summary.energy.balance_error, 5e-3);
    return summary.probes[0].second / (2 * traction * L / young);
  };
  const double coarse = std::abs(tip(21) - 1), fine = std::abs(tip(41) - 1);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, 0.7 * coarse);
}
