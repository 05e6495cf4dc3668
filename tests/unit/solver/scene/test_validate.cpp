#include "core/error.hpp"
#include "solver/scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

SceneSpec good() {
  SceneSpec scene;
  scene.material = {"hencky", 8930, 117e9, 0.35, PlasticitySpec{0.4e9, 0.1e9}};
  scene.end_time = 1e-5;
  scene.walls.push_back({});
  scene.fixed.push_back({"base", {true, false, false}});
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
            "offers: hencky");
}

TEST(Validate, RefusesImpossibleValues) {
  const double nan = std::nan("");
  EXPECT_NE(message([](SceneSpec& s) { s.material.density = -1; }), "");
  EXPECT_NE(message([&](SceneSpec& s) { s.material.young = nan; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.material.plasticity->yield = 0; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.material.plasticity->hardening = -1; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.formulation = "pFJ2"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.scheme = "best"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.kernel = "cubic"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.support = 1.0; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.neighbours = 3; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.jst4 = -0.1; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.cfl = 0; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.end_time = INFINITY; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.walls[0].normal.setZero(); }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.walls[0].restitution = 1.1; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.fixed[0].component = {false, false, false}; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.probes[0].quantity = "temperature"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.probes[0].reduce = "median"; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.probes.push_back(s.probes[0]); }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.frames = 0; }), "");
  EXPECT_NE(message([](SceneSpec& s) { s.history_rows = -5; }), "");
}
