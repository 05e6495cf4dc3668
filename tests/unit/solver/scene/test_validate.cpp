#include "core/error.hpp"
#include "solver/scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

SceneSpec good() {
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"hencky", 8930, 117e9, 0.35, LinearHardening{0.4e9, 0.1e9}};
  scene.end_time = 1e-5;
  scene.walls.push_back({});
  scene.boundary.push_back({BoundaryCondition::Kind::fixed, "base", {true, false, false}});
  scene.probes.push_back({"radius", "radius", "max", "all"});
  return scene;
}

/// The message for a scene that `spoil` has made bad, or "" when it passes.
template <class F>
std::string message(F&& spoil) {
  SceneSpec scene = good();
  spoil(scene);
  try {
    validate(scene, [](const std::string& key) { return "case.toml:" + key; });
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST(Validate, AGoodScenePasses) {
  EXPECT_EQ(message([](SceneSpec&) {}), "");
}

TEST(Validate, NamesKeyValuePlaceAndRange) {
  EXPECT_EQ(message([](SceneSpec& s) { s.material.poisson = 0.5; }),
            "material.poisson is 0.5, case.toml:material.poisson, it must be above -1 and below 0.5: at 0.5 "
            "pressure "
            "waves are infinitely fast");
  EXPECT_EQ(message([](SceneSpec& s) { s.material.law = "henky"; }),
            "material.law is \"henky\", case.toml:material.law, did you mean \"hencky\"? this version "
            "offers: hencky, linear_elastic, saint_venant_kirchhoff, neo_hookean, mooney_rivlin, ogden");
}

TEST(Validate, LooksAtTheConstantsOfTheLawOnly) {
  const auto elastic = [](const char* law) {
    return [law](SceneSpec& s) {
      s.material = {law, 1100, 0, 0, std::nullopt, 1e6, 0, {0.6e6, -0.01e6}, {1.3, -2}, 1e9};
    };
  };
  EXPECT_EQ(message(elastic("mooney_rivlin")), "");
  EXPECT_EQ(message(elastic("ogden")), "");
  EXPECT_EQ(message(elastic("neo_hookean")),
            "material.young is 0, case.toml:material.young, it must be positive (Pa)");
}

TEST(Validate, RefusesConstantsNoRubberHas) {
  const auto rubber = [](auto&& spoil) {
    return message([&](SceneSpec& s) {
      s.material = {"ogden", 1100, 0, 0, std::nullopt, 1e6, 0.5e6, {0.6e6, -0.01e6}, {1.3, -2}, 1e9};
      spoil(s.material);
    });
  };
  EXPECT_EQ(rubber([](MaterialSpec& m) { m.mu.push_back(1); }),
            "material.mu lists 3 and material.alpha 2 numbers, case.toml:material.mu, give both one number a "
            "term");
  EXPECT_EQ(
      rubber([](MaterialSpec& m) { m.alpha[1] = 2; }),
      "material.mu and material.alpha are -10000 and 2 in term 2, case.toml:material.mu.1, their product "
      "must be positive: both above zero or both below");
  EXPECT_NE(rubber([](MaterialSpec& m) { m.alpha[0] = 0; }), "");
  EXPECT_NE(rubber([](MaterialSpec& m) { m.mu.clear(), m.alpha.clear(); }), "");
  EXPECT_NE(rubber([](MaterialSpec& m) { m.bulk = 0; }), "");
  const auto mooney = [&](auto&& spoil) {
    return rubber([&](MaterialSpec& m) {
      m.law = "mooney_rivlin";
      spoil(m);
    });
  };
  EXPECT_EQ(mooney([](MaterialSpec&) {}), "");
  EXPECT_NE(mooney([](MaterialSpec& m) { m.c2 = -1; }), "");
  EXPECT_NE(mooney([](MaterialSpec& m) { m.c1 = m.c2 = 0; }), "");
  EXPECT_NE(mooney([](MaterialSpec& m) { m.bulk = std::nan(""); }), "");
}

TEST(Validate, OnlyHenckyFlows) {
  EXPECT_EQ(message([](SceneSpec& s) { s.material.law = "neo_hookean"; }),
            "material.plasticity stands beside the law \"neo_hookean\", which is elastic only, "
            "case.toml:material.plasticity, use law = \"hencky\", or leave the table out");
}

TEST(Validate, RefusesHardeningThatIsNone) {
  const auto power = [](double coefficient, double offset, double exponent) {
    return message([&](SceneSpec& s) {
      s.material.plasticity = PowerHardening{coefficient, offset, exponent};
    });
  };
  EXPECT_EQ(power(159e6, 0.02, 0.27), "");
  EXPECT_EQ(power(159e6, 0.02, 0), "");
  EXPECT_EQ(power(159e6, 0.02, 1), "");
  EXPECT_EQ(power(0, 0.02, 0.27),
            "material.plasticity.power.coefficient is 0, "
            "case.toml:material.plasticity.power.coefficient, it must be positive (Pa)");
  EXPECT_EQ(power(159e6, 0, 0.27), "material.plasticity.power.offset is 0, "
                                   "case.toml:material.plasticity.power.offset, it must be positive");
  EXPECT_EQ(power(159e6, 0.02, 1.1), "material.plasticity.power.exponent is 1.1, "
                                     "case.toml:material.plasticity.power.exponent, it must be from 0 to 1");
  EXPECT_NE(power(159e6, 0.02, -0.1), "");
  EXPECT_NE(power(INFINITY, 0.02, 0.27), "");
  EXPECT_NE(power(159e6, std::nan(""), 0.27), "");
}

TEST(Validate, ConstantsOfOtherDissipationsRest) {
  SceneSpec scene = good();
  scene.formulation = "pFJ";
  scene.jst4 = Kappa4{};
  scene.jst4_J = 0.1;
  scene.jst2 = 1;
  scene.residual = PlasticRamp{1, 0.1, 0.5};
  scene.residual_J = 1;
  const auto resting = [&](const std::string& scheme, const std::string& dissipation) {
    scene.scheme = scheme;
    scene.dissipation = dissipation;
    EXPECT_NO_THROW(validate(scene, [](const std::string& key) { return key; }));
    return resting_constants(scene);
  };
  using Keys = std::vector<std::string>;
  for (const std::string scheme : {"thesis", "consistent"}) {
    EXPECT_EQ(resting(scheme, "jst"), (Keys{"residual", "residual_J"}));
    EXPECT_EQ(resting(scheme, "jst_symmetric"), (Keys{"jst2", "residual", "residual_J"}));
    EXPECT_EQ(resting(scheme, "linear_residual"), (Keys{"jst4", "jst4_J", "jst2"}));
  }
  EXPECT_EQ(resting("thesis", "auto"), (Keys{"residual", "residual_J"}));
  EXPECT_EQ(resting("consistent", "auto"), (Keys{"jst4", "jst4_J", "jst2"}));
  EXPECT_EQ(resting_constants(good()), Keys{});
}

TEST(Validate, DissipationsAreNamedAndTheirConstantsInRange) {
  const auto with = [](const std::string& scheme, const std::string& dissipation, auto change) {
    return message([&](SceneSpec& s) {
      s.scheme = scheme;
      s.dissipation = dissipation;
      change(s);
    });
  };
  EXPECT_EQ(
      with("thesis", "jst_symetric", [](SceneSpec&) {}),
      "solver.dissipation is \"jst_symetric\", case.toml:solver.dissipation, did you mean \"jst_symmetric\"? "
      "this version offers: auto, jst, jst_symmetric, linear_residual");
  EXPECT_NE(with("consistent", "auto", [](SceneSpec& s) { s.residual = PlasticRamp::constant(5); }), "");
  EXPECT_NE(with("consistent", "auto", [](SceneSpec& s) { s.residual = PlasticRamp{1, 1, 0}; }), "");
  EXPECT_NE(message([](SceneSpec& s) { // J is not evolved
              s.dissipation = "linear_residual";
              s.residual_J = 1;
            }),
            "");
}

TEST(Validate, RefusesImpossibleValues) {
  const double nan = std::nan("");
  EXPECT_NE(message([](SceneSpec& s) { s.material.density = -1; }), "");
  EXPECT_NE(message([&](SceneSpec& s) { s.material.young = nan; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.material.plasticity = LinearHardening{0, 0.1e9}; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.material.plasticity = LinearHardening{0.4e9, -1}; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.formulation = "pFJ2"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.scheme = "best"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.kernel = "cubi"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.support = 1.0; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.neighbours = 3; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.jst4 = Kappa4::constant(-0.1); }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.jst2 = -1; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.involution = 0.2; }), ""); // nothing to tie where J is not evolved
  EXPECT_NE(message([](SceneSpec& s) { s.cfl = 0; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.end_time = INFINITY; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.walls[0].friction = -0.1; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.walls[0].stiffness = 0; }), "");
  EXPECT_NE(message([&](SceneSpec& s) { s.walls[0].velocity[1] = nan; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.walls[0].restitution = 1.1; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.boundary[0].component = {false, false, false}; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.probes[0].quantity = "temperature"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.probes[0].reduce = "median"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.probes.push_back(s.probes[0]); }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.frames = 0; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.history_rows = -5; }), "");
}
