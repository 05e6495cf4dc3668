#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solver/scene/forecast.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// A short copper bar thrown at a wall.
SceneSpec impact() {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"hencky", 8930, 117e9, 0.35, LinearHardening{0.4e9, 0.1e9}};
  scene.jst4 = Kappa4::constant(1.0 / 4096);
  scene.end_time = 3e-6;
  scene.initial.push_back({"all", Formulas{Expression("0"), Expression("0"), Expression("-227")}});
  scene.walls.push_back({});
  scene.probes = {{"radius", "radius", "max", "all"}, {"length", "z", "extent", "all"}};
  scene.frames = 4;
  scene.history_rows = 10;
  return scene;
}

struct Recorded {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::vector<double> frame_times;
  std::vector<double> last_displacement;
  Outputs outputs() {
    return {[this](const Frame& frame) {
              frame_times.push_back(frame.time);
              last_displacement.assign(frame.fields[0].values.begin(), frame.fields[0].values.end());
            },
            [this](const std::vector<std::string>& names) { columns = names; },
            [this](const std::vector<double>& row) { rows.push_back(row); }};
  }
};

} // namespace

TEST(Run, HandsOutFramesHistoryAndSummary) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  Recorded recorded;
  const Summary summary = run(impact(), cloud, recorded.outputs(), Progress::silent());
  EXPECT_EQ(recorded.frame_times.size(), 5u);
  EXPECT_EQ(recorded.frame_times.front(), 0);
  EXPECT_EQ(recorded.frame_times.back(), 3e-6);
  EXPECT_TRUE(std::is_sorted(recorded.frame_times.begin(), recorded.frame_times.end()));
  ASSERT_EQ(recorded.rows.size(), 11u);
  for (const auto& row : recorded.rows)
    ASSERT_EQ(row.size(), recorded.columns.size());
  EXPECT_EQ(recorded.columns[recorded.columns.size() - 2], "radius_m");
  EXPECT_EQ(summary.time, 3e-6);
  EXPECT_EQ(summary.formulation, "pF");
  EXPECT_EQ(summary.probes[0].first, "radius_m");
  EXPECT_EQ(summary.probes[0].second, recorded.rows.back()[recorded.columns.size() - 2]);
  EXPECT_GT(summary.extremes.equivalent_plastic_strain, 0.1);
  EXPECT_GE(summary.extent_min[2], 0);
}

TEST(Run, OutputDoesNotChangeTheStepsTaken) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  SceneSpec scene = impact();
  Recorded few, many;
  const Summary a = run(scene, cloud, few.outputs(), Progress::silent());
  scene.frames = 37;
  scene.history_rows = 1;
  const Summary b = run(scene, cloud, many.outputs(), Progress::silent());
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(few.last_displacement, many.last_displacement);
}

TEST(Run, GivesTheSameBitsOnAnyThreadCount) {
  const auto cloud = test::cylinder_lattice(4, 21, 0.64e-3);
  Recorded one, three;
  set_threads(1);
  run(impact(), cloud, one.outputs(), Progress::silent());
  set_threads(3);
  run(impact(), cloud, three.outputs(), Progress::silent());
  set_threads(0);
  EXPECT_EQ(one.rows, three.rows);
  EXPECT_EQ(one.last_displacement, three.last_displacement);
}

TEST(Run, ABlowUpNamesParticleStepAndTimeAndLeavesTheLastGoodFrame) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  SceneSpec scene = impact();
  scene.initial[0].velocity->at(2) = Expression("-9000"); // twice the speed of sound in copper
  scene.cfl = 1;
  Recorded recorded;
  try {
    run(scene, cloud, recorded.outputs(), Progress::silent());
    FAIL() << "survived";
  } catch (const RunError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("particle "), std::string::npos) << message;
    EXPECT_NE(message.find("step "), std::string::npos) << message;
    EXPECT_NE(message.find("time "), std::string::npos) << message;
    EXPECT_EQ(error.status(), ExitStatus::run_failed);
  }
  ASSERT_FALSE(recorded.last_displacement.empty());
  for (const double u : recorded.last_displacement)
    ASSERT_TRUE(std::isfinite(u));
  EXPECT_EQ(recorded.rows.back()[0], recorded.frame_times.back());
}

TEST(Run, ABarHardensByAPowerAsItDoesLinearly) {
  // Exponent 1 is the straight line of yield and hardening.
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  SceneSpec scene = impact();
  const Summary linear = run(scene, cloud, {}, Progress::silent());
  scene.material.plasticity = PowerHardening{0.1e9, 4, 1};
  const Summary straight = run(scene, cloud, {}, Progress::silent());
  EXPECT_GT(linear.extremes.equivalent_plastic_strain, 0.01);
  EXPECT_NEAR(straight.extremes.equivalent_plastic_strain / linear.extremes.equivalent_plastic_strain, 1,
              1e-9);
  EXPECT_NEAR(straight.energy.plastic / linear.energy.plastic, 1, 1e-9);
  // Curved, it keeps its ledger of energy as well.
  scene.material.plasticity = PowerHardening{0.6e9, 0.02, 0.27};
  const Summary curved = run(scene, cloud, {}, Progress::silent());
  EXPECT_GT(curved.extremes.equivalent_plastic_strain, 0.01);
  EXPECT_LT(curved.energy.balance_error, 2 * linear.energy.balance_error);
}

TEST(Run, ASupportTooSmallIsRefusedBeforeTheFirstStep) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  SceneSpec scene = impact();
  scene.support = 0.9;
  EXPECT_THROW(run(scene, cloud, {}, Progress::silent()), InputError);
}

TEST(Run, ABodyBehindItsWallIsRefused) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  SceneSpec scene = impact();
  scene.walls[0].shape = std::make_shared<Plane>(Vec3(0, 0, 1e-3));
  EXPECT_THROW(run(scene, cloud, {}, Progress::silent()), InputError);
}

TEST(Run, ElasticScenesRunInThePlaneAndWithoutDissipation) {
  const auto cloud = test::box_lattice(9, 9, 1, Vec3(1, 1, 0));
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.end_time = 0.02;
  scene.boundary = {{BoundaryCondition::Kind::fixed, "base"}};
  scene.initial.push_back({"all", Formulas{Expression("0.1*Y"), Expression("0"), Expression("0")}});
  scene.probes = {{"tip", "ux", "max", "top"}, {"foot", "ux", "extent", "base"}};
  for (const double jst4 : {0.0, 0.125}) {
    scene.jst4 = Kappa4::constant(jst4);
    const Summary summary = run(scene, cloud, {}, Progress::silent());
    EXPECT_GT(summary.probes[0].second, 5e-4);
    EXPECT_EQ(summary.probes[1].second, 0);
    EXPECT_LT(summary.energy.balance_error, 1e-3);
    EXPECT_EQ(summary.energy.plastic, 0);
  }
}

TEST(Run, ReactionsOfTheSupportsAreAllThatChangesTheMomentumOfAHeldBody) {
  const auto cloud = test::box_lattice(5, 5, 5, Vec3(1, 1, 1));
  SceneSpec scene;
  scene.material = {"hencky", 1100, 17e6, 0.3, std::nullopt};
  scene.end_time = 0.02;
  scene.history_rows = 7;
  const Formulas pulled{Expression("3*t/0.02"), Expression("0"), Expression("5")};
  scene.boundary = {
      {BoundaryCondition::Kind::fixed, "base"},
      {BoundaryCondition::Kind::velocity, "top", {true, false, true}, {pulled.begin(), pulled.end()}},
      {BoundaryCondition::Kind::sliding, "y_min"}};
  scene.initial.push_back({"all", Formulas{Expression("Z"), Expression("2*Z"), Expression("5*Z")}});
  for (const char* scheme : {"consistent", "thesis"}) {
    scene.scheme = scheme;
    Recorded recorded;
    run(scene, cloud, recorded.outputs(), Progress::silent());
    const auto column = [&](const std::string& name) {
      const auto found = std::find(recorded.columns.begin(), recorded.columns.end(), name);
      EXPECT_NE(found, recorded.columns.end()) << name;
      return found - recorded.columns.begin();
    };
    ASSERT_EQ(recorded.rows.size(), 8u);
    for (const std::string c : {"x", "y", "z"}) {
      const auto p = column("linear_momentum_" + c + "_kgm_s");
      double largest = 0;
      for (std::size_t i = 1; i < recorded.rows.size(); ++i) {
        const auto &before = recorded.rows[i - 1], &now = recorded.rows[i];
        double force = 0;
        for (const std::string set : {"base", "top", "y_min"}) {
          const double of_set = now[column(set + "_reaction_" + c + "_N")];
          largest = std::max(largest, std::abs(of_set));
          force += of_set;
        }
        EXPECT_NEAR(force, (now[p] - before[p]) / (now[0] - before[0]), 1e-10 * largest) << scheme << c << i;
      }
      EXPECT_GT(largest, 1e4) << scheme << c;
    }
    for (const std::string name : {"y_min_reaction_x_N", "y_min_reaction_z_N"})
      for (const auto& row : recorded.rows)
        EXPECT_EQ(row[column(name)], 0) << scheme;
  }
}

TEST(Run, EveryDissipationStandsWithEitherSchemeDownToSixNeighbours) {
  // Support 1.2: six neighbours inside, three at a corner, where there is no Laplacian.
  const auto cloud = test::box_lattice(5, 5, 5, Vec3(1, 1, 1));
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"neo_hookean", 1100, 17e6, 0.45, std::nullopt};
  scene.end_time = 0.005;
  scene.cfl = 0.3;
  scene.boundary = {{BoundaryCondition::Kind::fixed, "base"}};
  scene.initial.push_back(
      {"all", Formulas{Expression("-20*Z*(Y-0.5)"), Expression("20*Z*(X-0.5)"), Expression("0")}});
  scene.probes = {{"turned", "angle", "mean", "top", std::nullopt, Vec3(0.5, 0.5, 0)}};
  for (const std::string formulation : {"pF", "pFJ"})
    for (const std::string scheme : {"thesis", "consistent"})
      for (const std::string dissipation : {"jst", "jst_symmetric", "linear_residual"})
        for (const double support : {scheme == "thesis" ? 1.2 : 1.6, 2.2}) {
          SCOPED_TRACE(testing::Message()
                       << formulation << ' ' << scheme << ' ' << dissipation << ' ' << support);
          scene.formulation = formulation;
          scene.scheme = scheme;
          scene.dissipation = dissipation;
          scene.support = support;
          const Summary summary = run(scene, cloud, {}, Progress::silent());
          EXPECT_EQ(summary.dissipation, dissipation);
          EXPECT_GT(summary.probes[0].second, 2); // degrees
          EXPECT_GT(summary.energy.dissipated, 0);
          EXPECT_LT(summary.energy.balance_error, 0.005);
          const Forecast forecast = tessera::solver::forecast(scene, cloud);
          EXPECT_EQ(std::any_of(forecast.left_out.begin(), forecast.left_out.end(),
                                [](const Reasoned& part) {
                                  return part.what.find("by 8 particles") != std::string::npos;
                                }),
                    support < 2 && dissipation != "linear_residual");
        }
}

TEST(Forecast, SaysWhatIsModelledAndWhatTheFirstStepIs) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  const Forecast forecast = tessera::solver::forecast(impact(), cloud);
  const double c = std::sqrt(117e9 * 0.65 / (1.35 * 0.3) / 8930);
  EXPECT_NEAR(forecast.wave_speed / c, 1, 1e-12);
  EXPECT_NEAR(forecast.dt / (0.3 * 0.64e-3 / c), 1, 1e-9);
  EXPECT_NEAR(forecast.mass / (8930 * cloud.domain_volume), 1, 1e-12);
  EXPECT_GT(forecast.bytes_per_particle, 1000);
  const auto why = [](const std::vector<Reasoned>& list, const std::string& what) {
    for (const Reasoned& part : list)
      if (part.what == what)
        return part.why;
    return std::string("not among them");
  };
  EXPECT_EQ(why(forecast.modelled, "von Mises plasticity"), "[material.plasticity]");
  EXPECT_EQ(why(forecast.modelled, "contact with rigid tools"), "[[wall]] wall");
  EXPECT_EQ(why(forecast.left_out, "fixed velocities"), "no such [[boundary]]");
  EXPECT_EQ(why(forecast.left_out, "J, the volume ratio, as a field"),
            "Poisson's ratio 0.35 needs none: it does below 0.49");
  EXPECT_EQ(why(forecast.left_out, "the third dimension"), "not among them");
  EXPECT_EQ(why(forecast.choices, "formulation: {p, F}"), "auto: Poisson's ratio 0.35 is below 0.49");
  EXPECT_GT(forecast.step_cpu_seconds, 0);
  EXPECT_EQ(forecast.fastest_motion, 227);
}

TEST(Forecast, TheFieldThatBindsTheStepSwingsAndDecaysAsTheStepSays) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  SceneSpec scene = impact();
  scene.dissipation = "linear_residual";
  const StepChoice step = tessera::solver::forecast(scene, cloud).step;
  EXPECT_GT(step.decay, 0);
  EXPECT_NEAR(std::pow(step.critical * step.frequency, 2) + 2 * step.critical * step.decay, 4, 1e-9);
}

TEST(Run, EndsWhereItIsEnough) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  Outputs outputs;
  outputs.enough = [](double, std::int64_t steps) { return steps == 3; };
  const Summary summary = run(impact(), cloud, outputs, Progress::silent());
  EXPECT_EQ(summary.steps, 3);
  EXPECT_LT(summary.time, impact().end_time);
}

TEST(Forecast, SaysWhichOfTheTwoStepsBinds) {
  const auto cloud = test::cylinder_lattice(3, 11, 0.64e-3);
  SceneSpec scene = impact();
  const StepChoice heun = tessera::solver::forecast(scene, cloud).step;
  EXPECT_EQ(heun.bound, "wave");
  EXPECT_LT(0.3 * heun.by_wave, 0.8 * heun.critical);

  scene.integrator = "verlet";
  scene.cfl = 0.7;
  const Forecast verlet = tessera::solver::forecast(scene, cloud);
  EXPECT_EQ(verlet.step.bound, "critical");
  EXPECT_DOUBLE_EQ(verlet.step.by_wave, heun.by_wave);
  EXPECT_NEAR(verlet.dt / (0.7 * verlet.step.critical), 1, 1e-12);

  // Dissipation far stronger than usual takes the step over from (3.93).
  scene.integrator = "heun";
  scene.cfl = 0.3;
  scene.dissipation = "linear_residual";
  scene.jst4.reset();
  scene.residual = PlasticRamp::constant(4);
  const Forecast stiff = tessera::solver::forecast(scene, cloud);
  EXPECT_EQ(stiff.step.bound, "critical");
  EXPECT_LT(stiff.dt, 0.3 * stiff.step.by_wave);
  const Summary summary = run(scene, cloud, {}, Progress::silent());
  EXPECT_EQ(summary.step.bound, "critical");
  EXPECT_DOUBLE_EQ(summary.step.critical, stiff.step.critical);
}

TEST(Run, HalvesThatCannotSeeEachOtherDoNotFeelEachOther) {
  auto cloud = test::box_lattice(8, 4, 4, Vec3(0.07, 0.03, 0.03));
  ParticleSet left{"left", {}, {}};
  std::vector<std::array<std::int32_t, 2>> pairs;
  const auto is_left = [&](std::int32_t a) { return cloud.X[a].x() < 0.035; };
  for (std::int32_t a = 0; a < cloud.size(); ++a) {
    if (is_left(a))
      left.particles.push_back(a);
    for (std::int32_t b = a + 1; b < cloud.size(); ++b)
      if (is_left(a) != is_left(b))
        pairs.push_back({a, b});
  }
  cloud.sets.push_back(left);
  cloud.hidden = {cloud.size(), pairs};
  SceneSpec scene = impact();
  scene.material.plasticity.reset();
  scene.walls.clear();
  scene.momentum_projection = false;
  scene.initial = {{"left", Formulas{Expression("10*X/0.07"), Expression("0"), Expression("0")}}};
  Recorded recorded;
  run(scene, cloud, recorded.outputs(), Progress::silent());
  double moved = 0;
  for (std::int32_t a = 0; a < cloud.size(); ++a)
    for (int c = 0; c < 3; ++c) {
      const double u = recorded.last_displacement[3 * a + c];
      if (is_left(a))
        moved = std::max(moved, std::abs(u));
      else
        EXPECT_EQ(u, 0) << a;
    }
  EXPECT_GT(moved, 1e-6);
}

/// Heun's method amplifies shear waves of a stiff law beyond measure where nothing damps them; a linear law
/// lets no volume ratio turn negative at once.
TEST(Run, AStepThatCollapsesEndsTheRun) {
  const auto cloud = test::box_lattice(4, 4, 4, Vec3(1, 1, 1));
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.formulation = "displacement";
  scene.material = {"linear_elastic", 1000, 1e7, 0.49999, std::nullopt};
  scene.jst4 = Kappa4::constant(0);
  scene.end_time = 10;
  scene.initial.push_back({"all", Formulas{Expression("sin(9*Y)"), Expression("0"), Expression("0")}});
  try {
    run(scene, cloud, {}, Progress::silent());
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("the step has shrunk"), std::string::npos) << e.what();
  }
}

TEST(Run, SupportsBeyondTheSightOfTheCloudAreRefused) {
  auto cloud = test::box_lattice(5, 5, 5, Vec3(1, 1, 1));
  cloud.sight.assign(cloud.X.size(), 0.6);
  SceneSpec scene = impact();
  scene.walls.clear();
  EXPECT_NO_THROW(forecast(scene, cloud));
  scene.support = 2.5; // 0.625 m
  try {
    forecast(scene, cloud);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("sight"), std::string::npos) << e.what();
  }
}
