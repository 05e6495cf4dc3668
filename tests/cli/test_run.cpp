// The stages together: stored particles, interruption, threads, pictures.

#include "tests/cli/small_case.hpp"

#include "io/field_series.hpp"
#include "io/history.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

TEST(Run, SameBytesOnOneThreadAndTwo) {
  const Workplace place;
  write_small_case(place);
  // A curved CAD body, imported anew each time: the whole chain must repeat itself, not the solver alone.
  const std::vector<std::string> voronoi = {
      "--set", "particles.arrangement=voronoi",
      "--set", "particles.count=600",
      "--set", "solver.end_time=1e-6",
      "--set", "geometry.file=" TESSERA_SOURCE_DIR "/geometries/taylor_bar/taylor_bar.step"};
  for (const char* threads : {"1", "2"}) {
    std::vector<std::string> arguments = {"run", "case.toml", "--quiet", "--threads", threads, "-o", threads};
    arguments.insert(arguments.end(), voronoi.begin(), voronoi.end());
    const Result result = place.tessera(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  ASSERT_FALSE(place.read("1/cloud.vtp").empty());
  EXPECT_EQ(place.read("1/cloud.vtp"), place.read("2/cloud.vtp"));
  ASSERT_GT(lines(place.read("1/history.csv")).size(), 5U);
  EXPECT_EQ(place.read("1/history.csv"), place.read("2/history.csv"));
}

TEST(Run, SolveTakesTheStoredParticlesWhereTheyFit) {
  const Workplace place;
  write_small_case(place);
  ASSERT_EQ(place.tessera({"prepare", "case.toml", "--quiet", "-o", "out"}).status, 0);
  const Result stored = place.tessera({"solve", "case.toml", "-o", "out"});
  EXPECT_EQ(stored.status, 0) << stored.err;
  EXPECT_NE(stored.err.find("particles from out/cloud.vtp"), std::string::npos) << stored.err;

  const Result other = place.tessera({"solve", "case.toml", "-o", "out", "--set", "particles.spacing=0.005"});
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_EQ(other.err.find("particles from"), std::string::npos) << "other particles were asked for";
  EXPECT_NE(other.out.find("45 particles"), std::string::npos) << other.out;

  fs::remove(place / "box.geo");
  const Result named = place.tessera({"solve", "case.toml", "-o", "new", "--cloud", "out/cloud.vtp"});
  EXPECT_EQ(named.status, 0) << named.err;
  EXPECT_TRUE(fs::exists(place / "new" / "summary.json"));
  expect_error(place.tessera({"solve", "case.toml", "--quiet", "-o", "x", "--cloud", "case.toml"}),
               {"case.toml"});
  expect_error(place.tessera({"solve", "case.toml", "--quiet", "-o", "x", "--cloud", "none.vtp"}),
               {"none.vtp"});
  EXPECT_FALSE(fs::exists(place / "x"));
}

TEST(Run, InterruptedKeepsItsFramesAndSaysHowToGoOn) {
  const Workplace place;
  write_small_case(place);
  const pid_t process = place.start({"run", "case.toml", "--quiet", "-o", "out", "--set", "solver.end_time=1",
                                     "--set", "output.frames=100000", "--set", "initial.0.velocity=[0,0,0]"},
                                    {});
  const fs::path second_frame = place / "out" / "fields" / "fields_0001.vtu";
  for (int i = 0; i < 600 && !fs::exists(second_frame); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ASSERT_TRUE(fs::exists(second_frame)) << "the run does not begin";
  ::kill(process, SIGINT);
  const Result result = place.wait(process);
  expect_error(result,
               {"interrupted", "are kept in out", "tessera post out", "tessera solve out/case.toml -o out"},
               1);
  EXPECT_FALSE(fs::exists(place / "out" / "summary.json"));
  EXPECT_GE(io::read_series(place / "out").size(), 2U);
  EXPECT_GE(io::read_history(place / "out" / "history.csv").columns.front().size(), 2U);
  const Result drawn = place.tessera({"post", "out", "--quiet"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_TRUE(fs::exists(place / "out" / "report.md"));
}

TEST(Run, BlowUpKeepsTheLastGoodFrame) {
  const Workplace place;
  write_small_case(place);
  const Result result = place.tessera({"run", "case.toml", "--quiet", "-o", "out", "--set",
                                       "initial.0.velocity=[0,0,-1e5]", "--set", "solver.cfl=1"});
  expect_error(result, {"particle", "time", "are kept in out"}, 1);
  EXPECT_FALSE(fs::exists(place / "out" / "summary.json"));
  EXPECT_GE(io::read_series(place / "out").size(), 1U);
}

TEST(Run, PicturesOfEveryStyle) {
  const Workplace place;
  write_small_case(place);
  place.write("case.toml", small_case + R"(
[[output.picture]]
name = "strip"
field = "PlasticStrain"
frames = 3
outline = true

[[output.picture]]
name = "skin"
field = "VonMises"
style = "skin"
view = "iso"
clip = "y"
clip_at = 0.004
outline = true

[[output.picture]]
name = "moving"
field = "Velocity"
frames = [0, 1]
animation = true
)");
  Workplace::Surroundings screen;
  screen.pictures = true;
  const Result run = place.tessera({"run", "case.toml", "-o", "a"}, screen);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(fs::exists(place / "a" / "body.vtu"));
  if (run.err.find("xvfb-run is not installed") != std::string::npos)
    GTEST_SKIP() << "no xvfb-run on this machine";
  EXPECT_NE(run.err.find("moving.png: the run's frames go from"), std::string::npos) << run.err;
  for (const char* name : {"strip.png", "skin.png", "moving.png"})
    EXPECT_GT(place.read(std::string("a/") + name).size(), 10'000U) << name << "\n" << run.err;
  EXPECT_NE(place.read("a/moving.png").find("acTL"), std::string::npos);
  const Result refused = place.tessera({"post", "a", "--set", "output.picture.1.clip_at=5"}, screen);
  EXPECT_NE(refused.err.find("no skin.png: nothing of the body lies beyond"), std::string::npos)
      << refused.err;
}

TEST(Run, PicturesAndComparison) {
  const Workplace place;
  write_small_case(place);
  place.write("case.toml", small_case + "[[output.picture]]\nname = \"strain\"\nfield = \"PlasticStrain\"\n");
  Workplace::Surroundings screen;
  screen.pictures = true;
  const Result run = place.tessera({"run", "case.toml", "-o", "a"}, screen);
  ASSERT_EQ(run.status, 0) << run.err;
  if (run.err.find("xvfb-run is not installed") != std::string::npos)
    GTEST_SKIP() << "no xvfb-run on this machine";
  for (const char* name : {"strain.png", "cloud.png", "probes.png", "energies.png"})
    EXPECT_TRUE(fs::exists(place / "a" / name)) << name << "\n" << run.err;

  ASSERT_EQ(
      place.tessera({"run", "case.toml", "--quiet", "-o", "b", "--set", "particles.spacing=0.002"}).status,
      0);
  const Result compared = place.tessera({"compare", "a", "b", "-o", "c"}, screen);
  ASSERT_EQ(compared.status, 0) << compared.err;
  EXPECT_NE(compared.out.find("225"), std::string::npos) << compared.out;
  EXPECT_TRUE(fs::exists(place / "c" / "compare.json"));
  EXPECT_TRUE(fs::exists(place / "c" / "compare.csv"));
  EXPECT_NE(compared.out.find("difference from the first"), std::string::npos) << compared.out;

  // A line upwards through the box of 10 x 10 x 20 mm.
  const Result cut =
      place.tessera({"compare", "a", "b", "-o", "d", "--field", "Pressure", "--section",
                     "0.003,0.003,0.002:0.003,0.003,0.018", "--time", "first", "--clip", "none"},
                    screen);
  ASSERT_EQ(cut.status, 0) << cut.err;
  for (const char* name : {"compare_section_1.csv", "compare_section_1.png", "compare_pressure.png"})
    EXPECT_TRUE(fs::exists(place / "d" / name)) << name << "\n" << cut.err;
  expect_error(place.tessera({"compare", "a", "b", "-o", "e", "--field", "Presure"}),
               {"did you mean 'Pressure'"});
  expect_error(place.tessera({"compare", "a", "b", "-o", "e", "--section", "1,1,1:2,2,2"}),
               {"does not meet"});
  expect_error(place.tessera({"compare", "a", "b", "-o", "e", "--section", "-1,1"}),
               {"'-1,1' is no section"});
  expect_error(place.tessera({"compare", "a", "b", "-o", "e", "--time", "later"}),
               {"'later' names no frame"});
  EXPECT_FALSE(fs::exists(place / "e"));

  const Result exported = place.tessera({"export", "a", "--time", "first"});
  ASSERT_EQ(exported.status, 0) << exported.err;
  EXPECT_NE(exported.out.find("225 particles"), std::string::npos) << exported.out;
  EXPECT_TRUE(fs::exists(place / "a" / "fields_0000.csv"));
  expect_error(place.tessera({"export", "nowhere"}), {"there are no stored fields", "nowhere"});
}

} // namespace
} // namespace tessera::cli
