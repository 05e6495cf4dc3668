/// tessera stability: chapter 4's model, and the spectrum of a case's operators.
#include "tests/cli/small_case.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

using namespace tessera::cli;
using Json = nlohmann::json;

namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of 45 particles.
const std::vector<std::string> coarse = {"--set", "particles.spacing=0.005"};

std::vector<std::string> asked(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), coarse.begin(), coarse.end());
  return arguments;
}

} // namespace

TEST(Stability, WithoutACaseIsTheModelOfChapterFour) {
  const Workplace place;
  const Result result = place.tessera({"stability", "-o", "study", "--json", "--quiet"});
  EXPECT_EQ(result.status, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["tables"].size(), 2U);
  for (const Json& limit : json["limits"]) {
    if (limit["kappa4"] == 0.0) {
      EXPECT_EQ(limit["courant"], 0.0);
    } else if (limit["kappa4"] == 0.125) {
      EXPECT_NEAR(limit["courant"].get<double>(), 1, 1e-9);
    }
  }
  EXPECT_EQ(place.read("study/stability.json"), result.out);
  EXPECT_EQ(lines(place.read("study/waves.csv")).size(), 1U + 4 * 721);
  EXPECT_EQ(lines(place.read("study/kernels.csv")).size(), 1U + 5 + 7);
  EXPECT_NE(place.read("study/report.md").find("| ∇W | 0 | -1/34 | -15/34 | 0 | 15/34 | 1/34 | 0 |"),
            std::string::npos);
  // A second look goes to the same folder.
  EXPECT_EQ(place.tessera({"stability", "-o", "study", "--quiet"}).status, 0);
}

TEST(Stability, OfACaseFindsTheLargestStepAndLeavesTheRunAlone) {
  const Workplace place;
  write_small_case(place);
  const Result result = place.tessera(asked({"stability", "case.toml", "-o", "out", "--json"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["particles"], 45);
  EXPECT_EQ(json["integrator"], "verlet");
  const Json& spectrum = json["spectrum"];
  EXPECT_EQ(spectrum["eigenvalues"], 6 * 45);
  EXPECT_FALSE(spectrum["grows"].get<bool>());
  const double largest = spectrum["largest_step"];
  EXPECT_GT(json["dt_critical"].get<double>(), largest * (1 - 1e-9));
  EXPECT_LT(json["dt_critical"].get<double>(), largest * 1.05);
  EXPECT_NEAR(json["dt"].get<double>() / json["dt_critical"].get<double>(), 0.8, 1e-6);
  EXPECT_EQ(lines(place.read("out/eigenvalues.csv")).size(), 1U + 6 * 45);

  // Squeezed, waves cross the body sooner.
  const Result squeezed =
      place.tessera(asked({"stability", "case.toml", "-o", "out", "--json", "--stretch", "1,1,0.8"}));
  ASSERT_EQ(squeezed.status, 0) << squeezed.err;
  EXPECT_LT(Json::parse(squeezed.out)["spectrum"]["largest_step"].get<double>(), 0.95 * largest);

  // A run's files stay, its particles are taken.
  ASSERT_EQ(place.tessera(asked({"run", "case.toml", "-o", "out", "--quiet"})).status, 0);
  const std::vector<std::string> before = place.listing();
  const Result again = place.tessera(asked({"stability", "case.toml", "-o", "out"}));
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("particles from"), std::string::npos);
  EXPECT_NE(again.out.find("largest stable step"), std::string::npos);
  const std::vector<std::string> after = place.listing();
  for (const std::string& file : before)
    EXPECT_TRUE(has(after, file)) << file;
}

TEST(Stability, LargeBodiesGoWithoutEigenvalues) {
  const Workplace place;
  write_small_case(place);
  const Result result = place.tessera(
      {"stability", "case.toml", "--set", "particles.spacing=0.0015", "-o", "out", "--json", "--quiet"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_GT(json["unknowns"].get<int>(), 3000);
  EXPECT_TRUE(json["spectrum"].is_null());
  EXPECT_GT(json["dt_critical"].get<double>(), 0);
  EXPECT_FALSE(has(place.listing(), "out/eigenvalues.csv"));
}

TEST(Stability, BadInputIsToldInALine) {
  const Workplace place;
  write_small_case(place);
  expect_error(place.tessera({"stability", "nowhere.toml"}), {"nowhere.toml"});
  expect_error(place.tessera({"stability", "case.toml", "--stretch", "1,1"}), {"--stretch"});
  expect_error(place.tessera({"stability", "case.toml", "--stretch", "1,1,0"}),
               {"a stretch of 0", "--stretch"});
  expect_error(place.tessera({"stability", "case.toml", "--stretch", "1,1,nan"}), {"--stretch"});
  expect_error(place.tessera({"stability", "--stretch", "1,1,2"}), {"--stretch", "name a case"});
  expect_error(place.tessera({"stability", "--set", "solver.cfl=1"}), {"--set", "name a case"});
  EXPECT_FALSE(has(place.listing(), "runs"));
}
