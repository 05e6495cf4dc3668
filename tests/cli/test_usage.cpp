// Commands, options and case files that are wrong, as the shell sees them.

#include "tests/cli/small_case.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::cli {
namespace {

TEST(Usage, VersionAndHelp) {
  const Workplace place;
  const Result version = place.tessera({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.substr(0, 8), "tessera ");
  EXPECT_EQ(lines(version.out).size(), 1U);
  EXPECT_EQ(version.err, "");
  EXPECT_EQ(place.tessera({"run", "--version"}).out, version.out);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"run", "--help"}, {"compare", "-h"}}) {
    const Result help = place.tessera(arguments);
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("Usage: tessera"), std::string::npos) << help.out;
    EXPECT_EQ(help.err, "");
  }
}

TEST(Usage, WrongCommandsAndOptions) {
  const Workplace place;
  expect_error(
      place.tessera({}),
      {"no command", "run, prepare, solve, post, check, compare, export, study, stability, materials"});
  expect_error(place.tessera({"rum", "case.toml"}), {"unknown command 'rum'", "did you mean 'run'"});
  expect_error(place.tessera({"run", "case.toml", "--thread", "2"}),
               {"unknown option '--thread'", "did you mean '--threads'", "tessera run --help"});
  expect_error(place.tessera({"--jsn", "run", "case.toml"}),
               {"unknown option '--jsn'", "did you mean '--json'"});
  expect_error(place.tessera({"run"}), {"case", "tessera run --help"});
  expect_error(place.tessera({"run", "a.toml", "b.toml"}), {"unexpected argument 'b.toml'"});
  expect_error(place.tessera({"run", "case.toml", "--threads", "many"}), {"--threads"});
  expect_error(place.tessera({"run", "case.toml", "--threads", "0"}), {"--threads"});
  expect_error(place.tessera({"run", "case.toml", "-o"}), {"--output"});
  expect_error(place.tessera({"check", "case.toml", "--cells"}), {"unknown option '--cells'"});
  expect_error(place.tessera({"compare", "only_one"}), {"at least two runs"});
  expect_error(place.tessera({"compare", "a", "b"}), {"no finished run", "a"});
  for (const char* no_number : {"nan", "inf", "-1", "0", "large"})
    expect_error(place.tessera({"compare", "a", "b", "--magnify", no_number}),
                 {"--magnify", no_number, "greater than 0"});
  expect_error(place.tessera({"post", "nowhere"}), {"no run is stored here", "nowhere"});
  EXPECT_TRUE(place.listing().empty());
}

TEST(Usage, ACutThroughAPlaneBodyIsRefused) {
  const Workplace place;
  expect_error(
      place.tessera({"check", TESSERA_SOURCE_DIR "/geometries/punch", "--set", "output.picture.0.clip=x"}),
      {"plane body", "remove clip"});
}

TEST(Usage, MaterialsListsLawsAndHardenings) {
  const Workplace place;
  const Result text = place.tessera({"materials"});
  EXPECT_EQ(text.status, 0);
  EXPECT_EQ(text.err, "");
  for (const char* piece :
       {"mooney_rivlin\n", "(2.68), (2.132)", "list: one a term", "power.offset", "(5.7)"})
    EXPECT_NE(text.out.find(piece), std::string::npos) << piece;
  const Result machine = place.tessera({"materials", "--json"});
  EXPECT_EQ(machine.status, 0);
  const auto json = nlohmann::json::parse(machine.out);
  ASSERT_EQ(json["laws"].size(), 6U);
  EXPECT_EQ(json["laws"][0]["name"], "hencky");
  EXPECT_EQ(json["laws"][0]["plasticity"], true);
  EXPECT_EQ(json["laws"][5]["parameters"][1]["key"], "mu");
  EXPECT_EQ(json["laws"][5]["parameters"][1]["unit"], "Pa");
  EXPECT_EQ(json["laws"][5]["parameters"][1]["list"], true);
  ASSERT_EQ(json["hardenings"].size(), 2U);
  EXPECT_EQ(json["hardenings"][1]["parameters"][0]["key"], "power.coefficient");
  expect_error(place.tessera({"materials", "steel"}), {"unexpected argument 'steel'"});
  expect_error(place.tessera({"materials", "-o", "out"}), {"--hyperbolicity"});
  EXPECT_TRUE(place.listing().empty());
}

TEST(Usage, MaterialsAreStudiedForTheirWaves) {
  const Workplace place;
  const Result result = place.tessera({"materials", "--hyperbolicity", "-o", "study", "--json", "--quiet"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto laws = nlohmann::json::parse(result.out)["laws"];
  const auto of = [&](const std::string& label) {
    for (const auto& law : laws)
      if (law["label"] == label)
        return law;
    return nlohmann::json();
  };
  EXPECT_EQ(of("Neo-Hookean 0.45")["lost_fraction"], 0);
  EXPECT_NEAR(of("Ogden 0.4995")["paths"]["volumetric"]["lost_above"].get<double>(), 1.0895, 1e-4);
  EXPECT_TRUE(of("Ogden 0.4995")["paths"]["volumetric"]["lost_below"].is_null());
  EXPECT_EQ(lines(place.read("study/hyperbolicity.csv"))[0],
            "label,law,path,stretch,stretch_1,stretch_2,stretch_3,slowest_over_mu");
  EXPECT_EQ(place.read("study/hyperbolicity.json"), result.out);
}

TEST(Usage, MissingFiles) {
  const Workplace place;
  write_small_case(place);
  expect_error(place.tessera({"run", "nothing.toml"}), {"cannot open the case file", "nothing.toml"});
  place.write("case.toml", with("box.geo", "nothing.step"));
  for (const char* command : {"run", "prepare", "solve", "check"})
    expect_error(place.tessera({command, "case.toml"}),
                 {"there is no CAD file", "nothing.step", "case.toml:3:8"});
  EXPECT_EQ(place.listing(), (std::vector<std::string>{"box.geo", "case.toml"})) << "nothing may be written";
}

struct Spoilt {
  const char* name;
  std::string from, to;
  int column;
  std::vector<std::string> pieces;
};
void PrintTo(const Spoilt& spoilt, std::ostream* out) {
  *out << spoilt.name;
}

class SpoiltCase : public ::testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltCase, IsRefusedBeforeAnyWork) {
  const Spoilt& spoilt = GetParam();
  const Workplace place;
  write_small_case(place);
  place.write("case.toml", with(spoilt.from, spoilt.to));
  std::vector<std::string> pieces = spoilt.pieces;
  pieces.push_back("case.toml:" + std::to_string(line_of(spoilt.from)) + ":" + std::to_string(spoilt.column));
  expect_error(place.tessera({"run", "case.toml", "-o", "out"}), pieces);
  EXPECT_EQ(place.listing(), (std::vector<std::string>{"box.geo", "case.toml"}));
}

INSTANTIATE_TEST_SUITE_P(
    Usage, SpoiltCase,
    ::testing::Values(
        Spoilt{"UnknownKey", "density", "densty", 1, {"'material.densty'", "did you mean 'density'"}},
        Spoilt{"WrongType", "8930", "\"8930\"", 11, {"material.density", "a number"}},
        Spoilt{"NotANumber", "8930", "nan", 11, {"material.density is nan"}},
        Spoilt{"NegativeDensity", "8930", "-8930", 11, {"material.density is -8930"}},
        Spoilt{"PoissonHalf", "0.35", "0.5", 11, {"material.poisson is 0.5"}},
        Spoilt{"NoEndTime", "5e-6", "0", 12, {"solver.end_time is 0"}},
        Spoilt{"BrokenFormula", "-100]", "\"sin(\"]", 19, {"initial.0.velocity"}}),
    [](const auto& spoilt) { return std::string(spoilt.param.name); });

TEST(Usage, MissingUnitPointsAtTheTable) {
  const Workplace place;
  write_small_case(place);
  place.write("case.toml", with("unit = \"mm\"\n", ""));
  expect_error(place.tessera({"check", "case.toml"}), {"missing key 'geometry.unit'", "case.toml:2:1"});
}

TEST(Usage, OverridesAreCheckedLikeTheFile) {
  const Workplace place;
  write_small_case(place);
  expect_error(place.tessera({"--set", "material.poisson=0.5", "check", "case.toml"}),
               {"material.poisson is 0.5", "--set material.poisson=0.5"});
  expect_error(place.tessera({"check", "case.toml", "--set", "solver.clf=0.1"}),
               {"'solver.clf'", "--set solver.clf=0.1", "did you mean 'cfl'"});
}

TEST(Usage, FormulasWithoutAValueAreNamedWithTheirPlace) {
  const Workplace place;
  write_small_case(place);
  place.write("case.toml",
              small_case + "[[boundary]]\non = \"foot\"\ntype = \"traction\"\ntraction = [0, \"1/0\", 0]\n");
  const auto lines_before = std::count(small_case.begin(), small_case.end(), '\n');
  expect_error(place.tessera({"check", "case.toml", "--quiet"}),
               {"\"1/0\"", "boundary.0.traction.1, case.toml:" + std::to_string(lines_before + 4)});
}

TEST(Usage, SetsThatDoNotExistAreNamedWithTheirPlace) {
  const Workplace place;
  write_small_case(place);
  place.write("case.toml", with("on = \"foot\"", "on = \"fot\""));
  expect_error(place.tessera({"check", "case.toml", "--quiet"}),
               {"'fot'", "did you mean 'foot'", "case.toml:" + std::to_string(line_of("on = \"foot\""))});
}

TEST(Usage, ProbesOutsideTheBodyAreFoundByCheckToo) {
  const Workplace place;
  write_small_case(place);
  place.write("inside.toml", with("reduce = \"mean\"\non = \"foot\"", "at = [0.005, 0.005, 0.01]"));
  place.write("case.toml", with("reduce = \"mean\"\non = \"foot\"", "at = [0.005, 0.005, 0.03]"));
  expect_error(place.tessera({"check", "case.toml", "--quiet"}),
               {"(0.005, 0.005, 0.03) m lies outside the body", "move it into the body"});
  EXPECT_EQ(place.tessera({"check", "inside.toml", "--quiet"}).status, 0);
}

} // namespace
} // namespace tessera::cli
