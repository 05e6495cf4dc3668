// Where results go: folders that cannot be used, full disks, machine output.

#include "tests/cli/small_case.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include <filesystem>

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST(Output, FolderThatCannotBeMade) {
  const Workplace place;
  write_small_case(place);
  place.write("file", "not a folder");
  expect_error(place.tessera({"run", "case.toml", "--quiet", "-o", "file/out"}), {"file/out"});
  expect_error(place.tessera({"run", "case.toml", "--quiet", "-o", "file"}), {"file"});
  expect_error(place.tessera({"prepare", "case.toml", "--quiet", "-o", "/proc/tessera"}), {"/proc/tessera"});
}

TEST(Output, SomebodyElsesFolderIsLeftAlone) {
  const Workplace place;
  write_small_case(place);
  place.write("letters/dear.txt", "Dear");
  const auto before = place.listing();
  expect_error(place.tessera({"run", "case.toml", "--quiet", "-o", "letters"}),
               {"not a run's", "letters", "-o"});
  expect_error(place.tessera({"run", "case.toml", "--quiet", "-o", "."}), {"not a run's"});
  EXPECT_EQ(place.listing(), before);
  EXPECT_EQ(place.read("case.toml"), small_case);
}

TEST(Output, ARefusedCaseLeavesWhatWasThere) {
  const Workplace place;
  write_small_case(place);
  ASSERT_EQ(place.tessera({"prepare", "case.toml", "--quiet", "-o", "out"}).status, 0);
  const std::string cloud = place.read("out/cloud.vtp"), stored = place.read("out/case.toml");
  for (const char* command : {"prepare", "run"}) {
    expect_error(
        place.tessera({command, "case.toml", "--quiet", "-o", "out", "--set", "particles.spacing=1e-9"}),
        {"particles"});
    EXPECT_EQ(place.read("out/cloud.vtp"), cloud);
    EXPECT_EQ(place.read("out/case.toml"), stored);
    expect_error(
        place.tessera({command, "case.toml", "--quiet", "-o", "new", "--set", "particles.spacing=1e-9"}),
        {"particles"});
    EXPECT_FALSE(fs::exists(place / "new")) << "no folder for a run that never began";
  }
}

TEST(Output, CheckTakesACaseOfParticlesAlone) {
  const Workplace place;
  place.write("cube.toml", "[geometry]\nshape = \"box\"\nsize = [1, 1, 1]\n"
                           "[particles]\narrangement = \"lattice\"\nspacing = 0.25\n");
  const Result result = place.tessera({"check", "cube.toml", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json outlook = Json::parse(result.out);
  EXPECT_EQ(outlook["particles"], 125);
  EXPECT_FALSE(outlook.contains("mass"));
  expect_error(place.tessera({"run", "cube.toml", "--quiet"}), {"particles only", "[material]"});
}

TEST(Output, RunWritesWhatItPromises) {
  const Workplace place;
  write_small_case(place);
  const Result result = place.tessera({"run", "case.toml", "--threads", "2", "-o", "out", "--cells"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("writing to out"), std::string::npos);
  EXPECT_NE(result.err.find("xvfb"), std::string::npos) << "missing pictures are explained";
  EXPECT_NE(result.out.find("225 particles"), std::string::npos) << result.out;
  for (const char* name : {"case.toml", "cloud.vtp", "cells.vtu", "quality.json", "history.csv", "fields.pvd",
                           "summary.json", "report.md", "report.html"})
    EXPECT_TRUE(fs::exists(place / "out" / name)) << name;

  const Json summary = Json::parse(place.read("out/summary.json"));
  for (const char* key : {"case",        "version",
                          "formulation", "scheme",
                          "arrangement", "subvolumes",
                          "seed",        "dimension",
                          "particles",   "neighbours_mean",
                          "support",     "spacing",
                          "steps",       "time",
                          "dt_min",      "dt_max",
                          "step",        "wall_seconds",
                          "cpu_seconds", "setup_seconds",
                          "peak_bytes",  "us_per_particle_step",
                          "threads",     "bytes_per_particle",
                          "volume_sum",  "energy",
                          "momentum",    "max",
                          "min",         "extent_min",
                          "extent_max",  "probes"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary["particles"], 225);
  EXPECT_EQ(summary["threads"], 2);
  EXPECT_GT(summary["cpu_seconds"], 0);
  EXPECT_GT(summary["setup_seconds"], summary["cpu_seconds"]) << "a CAD import, and few steps";
  EXPECT_GT(summary["peak_bytes"], 10e6);
  EXPECT_LT(summary["peak_bytes"], 1e9);
  EXPECT_NEAR(summary["volume_sum"].get<double>(), 2e-6, 1e-18);
  EXPECT_NEAR(summary["time"].get<double>(), 5e-6, 1e-18);
  EXPECT_LT(summary["probes"]["length_m"].get<double>(), 0.02) << "the bar is shortened by the impact";
  EXPECT_EQ(Json::parse(place.read("out/quality.json"))["particles"], 225);

  // The folder is ours: the same command may run again, and the stored case alone repeats the run.
  const std::string history = place.read("out/history.csv");
  place.write("out/stale.png", "a picture of an earlier run");
  const Result again = place.tessera({"run", "out/case.toml", "--quiet", "-o", "out"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out + again.err, "") << "--quiet says nothing";
  EXPECT_EQ(place.read("out/history.csv"), history);
  EXPECT_FALSE(fs::exists(place / "out" / "stale.png"));
}

TEST(Output, DerivedFieldsAreStoredWhereAskedForOrDrawn) {
  const Workplace place;
  write_small_case(place);
  const auto frame = [&](const std::string& folder) {
    for (const fs::directory_entry& entry : fs::directory_iterator(place / folder / "fields"))
      return place.read(folder + "/fields/" + entry.path().filename().string());
    return std::string();
  };
  EXPECT_EQ(place.tessera({"run", "case.toml", "--quiet", "-o", "plain"}).status, 0);
  const Result result = place.tessera({"run", "case.toml", "--quiet", "-o", "more", "--set",
                                       "output.fields=[\"LodeAngle\", \"DeformationGradient\"]", "--set",
                                       "output.picture=[{name = \"triaxiality\", field = \"Triaxiality\"}]"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* name : {"LodeAngle", "DeformationGradient", "Triaxiality"}) {
    EXPECT_NE(frame("more").find(name), std::string::npos) << name;
    EXPECT_EQ(frame("plain").find(name), std::string::npos) << name;
  }
  expect_error(place.tessera({"run", "case.toml", "--set", "output.fields=[\"Lodeangle\"]"}),
               {"Lodeangle", "LodeAngle"});
}

TEST(Output, ADisplacementThatTurnsTheBodyInsideOutIsRefused) {
  const Workplace place;
  write_small_case(place);
  for (const char* command : {"run", "check"})
    expect_error(
        place.tessera({command, "case.toml", "--quiet", "--set", "initial.0.displacement=[\"-2*X\", 0, 0]"}),
        {"volume ratio J -1", "initial", "inside out"});
}

TEST(Output, DefaultFolderIsNamedAfterTheCase) {
  const Workplace place;
  write_small_case(place);
  fs::create_directories(place / "boxes");
  fs::rename(place / "box.geo", place / "boxes" / "box.geo");
  fs::rename(place / "case.toml", place / "boxes" / "fine.toml");
  const Result result = place.tessera({"prepare", "boxes/fine.toml"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(place / "runs" / "boxes-fine" / "cloud.vtp"));
}

TEST(Output, CheckWritesNothing) {
  const Workplace place;
  write_small_case(place);
  const auto before = place.listing();
  const Result text = place.tessera({"check", "case.toml", "--quiet"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_EQ(text.err, "");
  EXPECT_TRUE(text.out.starts_with("small box\n")) << "what was asked for is no chatter: " << text.out;
  const Result json = place.tessera({"check", "case.toml", "--json", "--threads", "1"});
  EXPECT_EQ(json.status, 0) << json.err;
  EXPECT_EQ(place.listing(), before);

  const Json outlook = Json::parse(json.out);
  EXPECT_EQ(outlook["particles"], 225);
  EXPECT_NEAR(outlook["mass"].get<double>(), 8930 * 2e-6, 1e-12);
  const double lambda = 117e9 * 0.35 / (1.35 * 0.3), mu = 117e9 / 2.7;
  EXPECT_NEAR(outlook["wave_speed"].get<double>(), std::sqrt((lambda + 2 * mu) / 8930), 1e-6);
  EXPECT_NEAR(outlook["upper"][2].get<double>(), 0.02, 1e-12);
  EXPECT_GT(outlook["steps"].get<int>(), 5);
}

TEST(Output, CheckForetellsTheStepsOfASmallRun) {
  const Workplace place;
  write_small_case(place);
  const Json outlook = Json::parse(place.tessera({"check", "case.toml", "--json", "--quiet"}).out);
  ASSERT_EQ(place.tessera({"run", "case.toml", "--quiet", "--no-pictures", "-o", "out"}).status, 0);
  const Json summary = Json::parse(place.read("out/summary.json"));
  EXPECT_NEAR(outlook["steps"].get<double>(), summary["steps"].get<double>(), 1)
      << "it was rehearsed as it is";
  EXPECT_EQ(outlook["rehearsals"].back()["particles"], 225);
  EXPECT_DOUBLE_EQ(outlook["bytes_per_particle"], summary["bytes_per_particle"]);
  EXPECT_GT(outlook["seconds"], outlook["setup_seconds"]);
}

TEST(Output, CheckExplainsWhatWasChosen) {
  const Workplace place;
  write_small_case(place);
  const Result text = place.tessera({"check", "case.toml", "--explain", "--quiet"});
  for (const char* piece :
       {"  left out", "surface loads (no such [[boundary]])", "contact with rigid tools ([[wall]]",
        "formulation: {p, F} (auto: Poisson's ratio 0.35 is below 0.49)",
        "kappa 0.5, falling to 0.2 at a plastic strain of 0.5", "swings at"})
    EXPECT_NE(text.out.find(piece), std::string::npos) << piece << " is not in\n" << text.out;
  const Json plain = Json::parse(place.tessera({"check", "case.toml", "--json"}).out);
  EXPECT_FALSE(plain.contains("choices"));
  const Json json = Json::parse(place.tessera({"check", "case.toml", "--json", "--explain"}).out);
  EXPECT_EQ(json["choices"].size(), 7U);
  for (const Json& choice : json["choices"])
    EXPECT_FALSE(choice["why"].get<std::string>().empty()) << choice["what"];
  EXPECT_GT(json["step"]["frequency"], 0);
}

TEST(Output, JsonIsAllThereIsOnStandardOutput) {
  const Workplace place;
  write_small_case(place);
  const auto parse = [](const Result& result) {
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(result.out, nullptr, false);
  };
  EXPECT_EQ(parse(place.tessera({"--json", "prepare", "case.toml", "-o", "a"}))["particles"], 225);
  EXPECT_EQ(parse(place.tessera({"solve", "--json", "case.toml", "-o", "a"}))["particles"], 225);
  EXPECT_EQ(parse(place.tessera({"run", "case.toml", "-o", "b", "--quiet", "--json"}))["particles"], 225);
  EXPECT_TRUE(parse(place.tessera({"post", "a", "--json"})).is_array());
  EXPECT_FALSE(parse(place.tessera({"compare", "a", "b", "-o", "c", "--json"})).is_discarded());
  const Result failed =
      place.tessera({"run", "case.toml", "--json", "--quiet", "-o", "d", "--set", "solver.cfl=-1"});
  expect_error(failed, {"solver.cfl"});
}

TEST(Output, ResultThatCannotBePrintedIsAFailure) {
  const Workplace place;
  write_small_case(place);
  Workplace::Surroundings full;
  full.out_file = "/dev/full";
  const Result result = place.tessera({"check", "case.toml", "--quiet", "--json"}, full);
  expect_error(result, {"standard output"}, 1);
}

TEST(Output, FullDiskFailsTheRunInOneLine) {
  const Workplace place;
  write_small_case(place);
  Workplace::Surroundings narrow;
  narrow.largest_file = 65536; // room for the import and for small clouds
  const Result at_once =
      place.tessera({"run", "case.toml", "--quiet", "-o", "a", "--set", "particles.spacing=0.001"}, narrow);
  expect_error(at_once, {"a/cloud.vtp"}, 1);
  EXPECT_FALSE(fs::exists(place / "a" / "cloud.vtp")) << "no half-written file";

  const Result later = place.tessera({"run", "case.toml", "--quiet", "-o", "b", "--set",
                                      "output.history_rows=100000", "--set", "solver.end_time=1e-3"},
                                     narrow);
  expect_error(later, {"history.csv", "are kept in b", "tessera post b"}, 1);
  EXPECT_FALSE(fs::exists(place / "b" / "summary.json"));
  EXPECT_TRUE(fs::exists(place / "b" / "fields.pvd"));
}

} // namespace
} // namespace tessera::cli
