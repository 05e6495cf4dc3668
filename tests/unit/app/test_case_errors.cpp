#include "tests/unit/app/case_text.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

namespace tessera::app {
namespace {

/// Line of complete_case (from 1) on which `text` stands.
std::string place(const std::string& text, int column) {
  const std::size_t at = complete_case.find(text);
  const auto line =
      1 + std::count(complete_case.begin(), complete_case.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return "case.toml:" + std::to_string(line) + ":" + std::to_string(column);
}

/// The message contains every piece.
void expect_pieces(const std::string& line, const std::vector<std::string>& pieces) {
  for (const std::string& piece : pieces)
    EXPECT_NE(line.find(piece), std::string::npos) << "'" << piece << "' is not in: " << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

TEST(CaseErrors, UnknownKeyNamesPlaceNearestKeyAndList) {
  EXPECT_EQ(message(with("density = 8930", "densty = 8930")),
            "unknown key 'material.densty', " + place("density", 1) +
                ", did you mean 'density'? keys in material: law, density, young, poisson, plasticity");
}

struct Bad {
  const char* name;
  std::string from, to;
  std::vector<std::string> pieces;
};

void PrintTo(const Bad& bad, std::ostream* out) {
  *out << bad.name;
}

class BadCase : public ::testing::TestWithParam<Bad> {};

TEST_P(BadCase, IsRefusedWithItsPlace) {
  expect_pieces(message(with(GetParam().from, GetParam().to)), GetParam().pieces);
}

INSTANTIATE_TEST_SUITE_P(
    CaseErrors, BadCase,
    ::testing::Values(
        Bad{"UnknownTable",
            "[material]",
            "[materil]",
            {"unknown key 'materil'", place("[material]", 2), "material"}},
        Bad{"UnknownTopKey",
            "title",
            "titel",
            {"unknown key 'titel'", "case.toml:1:1", "did you mean 'title'"}},
        Bad{"ShapeNeedsNoUnit",
            "file = \"bar.step\"",
            "shape = \"box\"\nsize = [1, 1, 1]",
            {"geometry.unit stands beside a shape, whose lengths are in metres", "case.toml:5:8",
             "leave it out"}},
        Bad{"UnknownShape",
            "file = \"bar.step\"\nunit = \"mm\"",
            "shape = \"bix\"\nsize = [1, 1, 1]",
            {"bix", "box"}},
        Bad{"ShapeOfThePlaneInSpace",
            "file = \"bar.step\"\nunit = \"mm\"",
            "shape = \"rectangle\"\nsize = [1, 1]",
            {"rectangle"}},
        Bad{"TooFewLengths",
            "file = \"bar.step\"\nunit = \"mm\"",
            "shape = \"box\"\nsize = [1, 1]",
            {"geometry.size is a list of 2", "a list of 3 numbers"}},
        Bad{"FileAndShape",
            "file = \"bar.step\"\nunit = \"mm\"",
            "file = \"bar.step\"\nshape = \"box\"\nsize = [1, 1, 1]",
            {"both file and shape"}},
        Bad{"UnknownInEntry",
            "reduce = \"extent\"",
            "reduce = \"extent\"\nover = \"all\"",
            {"unknown key 'output.probe.0.over'", "keys in output.probe.0: name, quantity, at, reduce, on"}},
        Bad{"MissingUnit", "unit = \"mm\"\n", "", {"missing key 'geometry.unit'", place("[geometry]", 1)}},
        Bad{"MissingDensity",
            "density = 8930\n",
            "",
            {"missing key 'material.density'", place("[material]", 1)}},
        Bad{"MissingYoung", "young = 117e9\n", "", {"missing key 'material.young'"}},
        Bad{"MissingLaw", "law = \"hencky\"\n", "", {"missing key 'material.law'"}},
        Bad{"ConstantsOfAnotherLaw",
            "law = \"hencky\"",
            "law = \"mooney_rivlin\"",
            {"unknown key 'material.poisson'", "keys in material: law, density, c1, c2, bulk, plasticity"}},
        Bad{"TwoHardenings",
            "poisson = 0.35",
            "poisson = 0.35\nplasticity = {yield = 1e8, power = {coefficient = 1e8, offset = 1, exponent = "
            "0}}",
            {"material.plasticity.yield stands beside power", "keep yield and hardening, or power"}},
        Bad{"HardeningOfNoStrength",
            "poisson = 0.35",
            "poisson = 0.35\nplasticity.power = {coefficient = -1, offset = 0.02, exponent = 0.27}",
            {"material.plasticity.power.coefficient is -1", "it must be positive (Pa)"}},
        Bad{"PartOfAPower",
            "poisson = 0.35",
            "poisson = 0.35\nplasticity.power = {coefficient = 1e8, exponent = 0.27}",
            {"missing key 'material.plasticity.power.offset'"}},
        Bad{"MisspeltConstant",
            "law = \"hencky\"\ndensity = 8930\nyoung = 117e9\npoisson = 0.35",
            "law = \"ogden\"\ndensity = 8930\nmu = [1e6]\nalfa = [2]\nbulk = 1e9",
            {"unknown key 'material.alfa'", "did you mean 'alpha'"}},
        Bad{"MissingConstant",
            "law = \"hencky\"\ndensity = 8930\nyoung = 117e9\npoisson = 0.35",
            "law = \"mooney_rivlin\"\ndensity = 8930\nc1 = 1e6\nbulk = 1e9",
            {"missing key 'material.c2'"}},
        Bad{"NumberForList",
            "law = \"hencky\"\ndensity = 8930\nyoung = 117e9\npoisson = 0.35",
            "law = \"ogden\"\ndensity = 8930\nmu = 1e6\nalpha = [2]\nbulk = 1e9",
            {"material.mu is a number", "a list of numbers such as"}},
        Bad{"WrongSignInThesisConstants",
            "law = \"hencky\"\ndensity = 8930\nyoung = 117e9\npoisson = 0.35",
            "law = \"mooney_rivlin\"\ndensity = 8930\nmu1 = 1e6\nmu2 = 1e6\nbulk = 1e9",
            {"material.mu2 is 1000000", "0 or less"}},
        Bad{"MissingEndTime", "end_time = 80e-6\n", "", {"missing key 'solver.end_time'"}},
        Bad{"MissingTable", "[solver]\nend_time = 80e-6\n", "", {"missing key 'solver'"}},
        Bad{"WrongTypeNumber",
            "8930",
            "\"heavy\"",
            {"material.density is text in quotes", place("density", 11), "must be a number"}},
        Bad{"WrongTypeText", "\"mm\"", "1", {"geometry.unit is a number", place("unit", 8)}},
        Bad{"WrongTypeList", "[0, \"10*Z/6\", -227]", "[0, 1]", {"initial.0.velocity is a list", "three"}},
        Bad{"WrongTypeInList", "\"10*Z/6\"", "true", {"initial.0.velocity.1 is true or false"}},
        Bad{"TableInsteadOfList", "[[wall]]", "[wall]", {"wall is a table", "[[wall]]"}},
        Bad{"DateForNumber", "8930", "2020-01-01", {"material.density is a date or time"}},
        Bad{"NotANumber", "8930", "nan", {"material.density is nan", place("density", 11), "finite"}},
        Bad{"Infinite", "80e-6", "inf", {"solver.end_time is inf", "finite"}},
        Bad{"PoissonHalf", "0.35", "0.5", {"material.poisson is 0.5", place("poisson", 11)}},
        Bad{"NegativeDensity", "8930", "-1", {"material.density is -1", place("density", 11), "positive"}},
        Bad{"ZeroYoung", "117e9", "0", {"material.young is 0"}},
        Bad{"ZeroEndTime", "80e-6", "0", {"solver.end_time is 0"}},
        Bad{"NegativeCfl", "end_time = 80e-6", "end_time = 80e-6\ncfl = -0.3", {"solver.cfl is -0.3"}},
        Bad{"ZeroSpacing", "0.001", "0", {"particles.spacing is 0", "greater than 0"}},
        Bad{"SpacingAndCount", "0.001", "0.001\ncount = 5", {"both spacing and count"}},
        Bad{"NeitherSpacingNorCount",
            "spacing = 0.001\n",
            "",
            {"neither spacing nor count", place("[particles]", 1)}},
        Bad{"FractionalCount", "spacing = 0.001", "count = 2.5", {"particles.count is 2.5", "whole number"}},
        Bad{"NegativeSeed", "0.001", "0.001\nseed = -1", {"particles.seed is -1"}},
        Bad{"UnknownArrangement",
            "\"lattice\"",
            "\"latice\"",
            {"'latice'", "did you mean 'lattice'", "voronoi"}},
        Bad{"UnknownUnit", "\"mm\"", "\"furlong\"", {"furlong", place("unit", 8), "mm"}},
        Bad{"FourDimensions", "unit = \"mm\"", "unit = \"mm\"\ndimension = 4", {"geometry.dimension"}},
        Bad{"UnknownLaw", "\"hencky\"", "\"henky\"", {"henky", "hencky", place("law", 7)}},
        Bad{"BadFormula", "10*Z/6", "10*Q/6", {"initial.0", place("velocity", 16)}},
        Bad{"VelocityAndSpin",
            "-227]",
            "-227]\nspin = {omega = [0, 0, 1], centre = [0, 0, 0]}",
            {"both velocity and spin"}},
        Bad{"NoVelocity",
            "velocity = [0, \"10*Z/6\", -227]\n",
            "",
            {"nothing to set", place("[[initial]]", 1)}},
        Bad{"ComponentsOfClamped",
            "type = \"clamped\"",
            "type = \"clamped\"\ncomponents = [\"x\"]",
            {"unknown key 'boundary.0.components'"}},
        Bad{"NoComponents",
            "type = \"clamped\"",
            "type = \"fixed\"",
            {"missing key 'boundary.0.components'"}},
        Bad{"ComponentTwice",
            "type = \"clamped\"",
            "type = \"fixed\"\ncomponents = [\"x\", \"x\"]",
            {"'x' twice"}},
        Bad{"ZeroNormal", "normal = [0, 0, 1]", "normal = [0, 0, 0]", {"normal is zero", place("plane", 38)}},
        Bad{"TwoSelectors",
            "name = \"base\"",
            "name = \"base\"\nnearest = [0, 0, 0]",
            {"'base' has 2 selectors"}},
        Bad{"ReservedSet", "name = \"base\"", "name = \"all\"", {"may not be called 'all'"}},
        Bad{"BadName", "name = \"length\"", "name = \"a,b\"", {"output.probe.0.name is 'a,b'"}},
        Bad{"UnknownQuantity", "quantity = \"z\"", "quantity = \"w\"", {"output.probe.0.quantity", "radius"}},
        Bad{"UnknownField", "\"PlasticStrain\"", "\"PlasticStrian\"", {"did you mean 'PlasticStrain'"}},
        Bad{"PictureOutsideTheFolder",
            "name = \"strain\"",
            "name = \"../strain\"",
            {"output.picture.0.name"}},
        Bad{"UnknownStyle",
            "name = \"strain\"",
            "name = \"strain\"\nstyle = \"skim\"",
            {"output.picture.0.style", "skin"}},
        Bad{"FrameAndFrames",
            "name = \"strain\"",
            "name = \"strain\"\nframe = 0\nframes = 3",
            {"a frame and several"}},
        Bad{"TooManyAbreast",
            "name = \"strain\"",
            "name = \"strain\"\nframes = 40",
            {"more than 12 frames side by side", "animation"}},
        Bad{"CutNowhere", "name = \"strain\"", "name = \"strain\"\nclip_at = 0.01", {"clip_at does nothing"}},
        Bad{"BrokenToml", "young = 117e9", "young = ", {"not valid TOML", place("young", 1).substr(0, 13)}},
        Bad{"RepeatedKey", "law = \"hencky\"", "law = \"hencky\"\nlaw = \"hencky\"", {"not valid TOML"}}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(CaseErrors, TwoSetsOfOneName) {
  EXPECT_NE(message(complete_case + "[[set]]\nname = \"base\"\nnearest = [0, 0, 0]\n").find("two sets"),
            std::string::npos);
}

TEST(CaseErrors, PictureNamesAreDistinct) {
  const std::string twice = complete_case + "[[output.picture]]\nname = \"strain\"\nfield = \"VonMises\"\n";
  EXPECT_NE(message(twice).find("two pictures are called 'strain'"), std::string::npos);
}

TEST(CaseErrors, OverridesNameThemselves) {
  expect_pieces(message(complete_case, {"material.poisson=0.5"}), {"0.5, --set material.poisson=0.5, "});
  expect_pieces(message(complete_case, {"material.poison=0.4"}),
                {"unknown key 'material.poison', --set material.poison=0.4, did you mean 'poisson'?"});
  expect_pieces(message(complete_case, {"solver.cfl=fast"}),
                {"solver.cfl is text in quotes, --set solver.cfl=fast"});
  expect_pieces(message(complete_case, {"material.plasticity.yield=1e8"}),
                {"missing key 'material.plasticity.hardening', --set material.plasticity.yield=1e8"});
  expect_pieces(message(complete_case, {"wall.restitution=1"}), {"'restitution' is not an entry", "0 to 1"});
  expect_pieces(message(complete_case, {"wall.7.restitution=1"}), {"'7' is not an entry"});
  expect_pieces(message(complete_case, {"title.x=1"}), {"plain value before 'x'"});
  expect_pieces(message(complete_case, {"solver.cfl"}), {"key and a value", "--set solver.cfl"});
  expect_pieces(message(complete_case, {"=1"}), {"key and a value"});
  expect_pieces(message(complete_case, {"a..b=1"}), {"empty"});
  expect_pieces(message(complete_case, {"solver.cfl="}), {"not valid TOML"});
  expect_pieces(message(complete_case, {"initial.0.velocity=[1,2"}), {"not valid TOML"});
  expect_pieces(message(complete_case, {"title=x\ninjected=1", "solver.cfl=-1"}), {"solver.cfl is -1"});
}

TEST(CaseErrors, HostileFilesAreRefusedInOneLine) {
  std::string deep_key = "a", deep_list = "x = ", deep_header = "[a";
  for (int i = 0; i < 50'000; ++i) {
    deep_key += ".a";
    deep_list += "[";
    deep_header += ".a";
  }
  expect_pieces(message(deep_key + " = 1\n"), {"16 deep", "case.toml:1:"});
  expect_pieces(message(deep_list), {"16 deep", "case.toml:1:"});
  expect_pieces(message(deep_header + "]\n"), {"16 deep"});
  expect_pieces(message("x = {y = 1, " + deep_key + " = 1}\n"), {"16 deep"});
  expect_pieces(message(std::string((1 << 20) + 1, '#')), {"1 MiB"});
  expect_pieces(message(std::string(300'000, 'k') + " = 1\n"), {"unknown key", "..."});
  expect_pieces(message(std::string("\xff\xfe\x00\x01", 4)), {"not valid TOML"});
  expect_pieces(message("\"a\\u001b[31m\" = 1\n"), {"unknown key 'a?[31m'"});
  expect_pieces(message(""), {"missing key 'geometry'"});
  const std::string with_dots = with("a bar", "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t [[[[[[[[[[[[[[[[[[[[");
  EXPECT_EQ(message(with_dots), "no error") << "dots and brackets inside strings do not nest";
}

TEST(CaseErrors, MissingFileAndFolderWithoutCase) {
  const CaseFolder folder;
  EXPECT_THROW(read_case(folder.path() / "nothing.toml", {}), InputError);
  try {
    read_case(folder.path(), {});
    FAIL();
  } catch (const InputError& e) {
    expect_pieces(e.what(), {"folder without a case.toml"});
  }
}

} // namespace
} // namespace tessera::app
