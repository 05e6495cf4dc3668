// `tessera study`: a grid of runs, gone on with after an interruption.

#include "tests/cli/small_case.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string study_head = R"(title = "small study"
case = "case.toml"
[common]
solver.end_time = 2e-6
)";
const std::string by_length = "[error]\nprobe = \"length\"\nvalue = 0.0198\ntargets = [0.5, 1e-9]\n";

std::string axis(const std::string& name, const std::string& rest) {
  return "[[axis]]\nname = \"" + name + "\"\n" + rest + "\n";
}
const std::string by_spacing = axis("spacing", "key = \"particles.spacing\"\nvalues = [0.005, 0.0025]");

/// The study's runs by their labels "a, b".
std::map<std::string, Json> runs_of(const Workplace& place, const std::string& folder) {
  std::map<std::string, Json> runs;
  const Json study = Json::parse(place.read(folder + "/study.json"));
  for (const Json& run : study.at("runs")) {
    std::string words;
    for (const auto& [name, label] : run.at("labels").items())
      words += (words.empty() ? "" : ", ") + label.get<std::string>();
    runs[words] = run;
  }
  return runs;
}

TEST(Study, RunsTheGridAndOnlyOnce) {
  const Workplace place;
  write_small_case(place);
  place.write("study.toml",
              study_head + by_length +
                  axis("scheme", "key = \"solver.scheme\"\nvalues = [\"consistent\", \"thesis\"]") +
                  by_spacing + "[[exclude]]\nscheme = \"thesis\"\nspacing = 0.0025\n");
  const Result result = place.tessera({"study", "study.toml", "-o", "out", "--threads", "2"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("3 runs measured, 0 without an error"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("for 50 % error of length: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("error of length: no run reaches it"), std::string::npos) << result.out;
  const auto runs = runs_of(place, "out");
  ASSERT_EQ(runs.size(), 3U);
  const Json& fine = runs.at("consistent, 0.0025");
  EXPECT_EQ(fine["particles"], 225);
  EXPECT_GT(fine["cpu_seconds"], 0);
  EXPECT_GT(fine["setup_seconds"], 0);
  const std::string summary = place.read("out/" + fine["folder"].get<std::string>() + "/summary.json");
  const double length = Json::parse(summary).at("probes").at("length_m");
  EXPECT_DOUBLE_EQ(fine["error"], std::abs(length - 0.0198) / 0.0198);
  EXPECT_EQ(lines(place.read("out/study.csv")).size(), 4U);
  EXPECT_NE(place.read("out/report.md").find("# small study"), std::string::npos);

  // Nothing is left to do: the figures are those measured before, to the last digit of their processor time.
  const Result again = place.tessera({"study", "study.toml", "-o", "out", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("3 runs, 0 of them to do"), std::string::npos) << again.err;
  EXPECT_EQ(Json::parse(again.out), Json::parse(place.read("out/study.json")));
  EXPECT_EQ(runs_of(place, "out").at("consistent, 0.0025"), fine);

  // One more on an axis: one run more, two were there.
  place.write("study.toml",
              study_head + by_length + axis("scheme", "key = \"solver.scheme\"\nvalues = [\"consistent\"]") +
                  axis("spacing", "key = \"particles.spacing\"\nvalues = [0.005, 0.0025, 0.01]"));
  const Result more = place.tessera({"study", "study.toml", "-o", "out"});
  ASSERT_EQ(more.status, 0) << more.err;
  EXPECT_NE(more.err.find("3 runs, 1 of them to do"), std::string::npos) << more.err;
}

TEST(Study, AStudysFolderIsNoRunsNorTheOtherWayRound) {
  const Workplace place;
  write_small_case(place);
  ASSERT_EQ(place.tessera({"run", "case.toml", "--quiet", "--no-pictures", "-o", "run"}).status, 0);
  place.write("study.toml", study_head + by_length + by_spacing);
  expect_error(place.tessera({"study", "study.toml", "-o", "run"}),
               {"not a study's", "name an empty or new folder"});
  place.write("study/study.toml", "# Written by tessera\n");
  expect_error(place.tessera({"run", "case.toml", "-o", "study"}),
               {"not a run's", "name an empty or new folder"});
}

TEST(Study, InterruptedGoesOnWhereItWas) {
  const Workplace place;
  write_small_case(place);
  // Neither is longer than the other to look at, so the short one is taken first and the endless one after
  // it.
  place.write("study.toml",
              study_head + by_length +
                  axis("time", "values = [{label = \"short\", output.history_rows = 3}, "
                               "{label = \"endless\", output.history_rows = 5, solver.cfl = 1e-5}]"));
  const pid_t process = place.start({"study", "study.toml", "-o", "out", "--threads", "2"}, {});
  const auto finished = [&] {
    int found = 0;
    std::error_code none;
    for (const fs::directory_entry& run : fs::directory_iterator(place / "out" / "runs", none))
      found += fs::exists(run.path() / "summary.json") ? 1 : 0;
    return found;
  };
  for (int i = 0; i < 600 && finished() < 1; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ASSERT_EQ(finished(), 1) << "no run of the study ends";
  ::kill(process, SIGINT);
  const Result result = place.wait(process);
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(
      result.err.find("error: interrupted, 1 of 2 runs left to do, run the same command again to go on"),
      std::string::npos)
      << result.err;
  const auto kept = runs_of(place, "out");
  EXPECT_EQ(kept.at("endless").at("failure"), "not run");
  EXPECT_GT(kept.at("short").at("cpu_seconds"), 0);

  place.write("study.toml", study_head + by_length +
                                axis("time", "values = [{label = \"short\", output.history_rows = 3}, "
                                             "{label = \"endless\", output.history_rows = 5}]"));
  const Result rest = place.tessera({"study", "study.toml", "-o", "out"});
  ASSERT_EQ(rest.status, 0) << rest.err;
  EXPECT_NE(rest.err.find("2 runs, 1 of them to do"), std::string::npos) << rest.err;
  EXPECT_EQ(runs_of(place, "out").at("short"), kept.at("short"));
}

TEST(Study, AFailedRunIsARowAndNotTheEnd) {
  const Workplace place;
  write_small_case(place);
  place.write("study.toml",
              study_head + by_length +
                  axis("speed", "values = [{label = \"slow\"}, {label = \"too fast\", initial.0.velocity = "
                                "[0, 0, -1e6]}]"));
  const Result result = place.tessera({"study", "study.toml", "-o", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("1 run measured, 1 without an error"), std::string::npos) << result.out;
  const auto runs = runs_of(place, "out");
  EXPECT_TRUE(runs.at("slow").at("failure").is_null());
  EXPECT_EQ(runs.at("too fast").at("verdict"), "unstable");
  EXPECT_NE(runs.at("too fast").at("failure").get<std::string>().find("particle"), std::string::npos);
  EXPECT_TRUE(runs.at("too fast").at("error").is_null());
  EXPECT_NE(
      place.read("out/report.md").find("## Without an error\n\n| run | why |\n|:--|:--|\n| too fast | "),
      std::string::npos);

  EXPECT_NE(place.tessera({"study", "study.toml", "-o", "out"}).err.find("0 of them to do"),
            std::string::npos);
  const Result retried = place.tessera({"study", "study.toml", "-o", "out", "--retry-failed"});
  EXPECT_NE(retried.err.find("1 of them to do"), std::string::npos) << retried.err;
}

TEST(Study, ARunThatTakesTooLongIsEndedAndTriedAgain) {
  const Workplace place;
  write_small_case(place);
  const std::string rest = study_head + by_length;
  place.write("study.toml", rest + axis("time", "values = [{label = \"short\"}]"));
  ASSERT_EQ(place.tessera({"study", "study.toml", "--quiet", "-o", "out"}).status, 0);
  place.write("study.toml",
              "time_limit = 1\n" + rest +
                  axis("time", "values = [{label = \"short\"}, {label = \"endless\", solver.cfl = 1e-6}]"));
  for (int i = 0; i < 2; ++i) {
    const Result result = place.tessera({"study", "study.toml", "-o", "out"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("2 runs, 1 of them to do"), std::string::npos) << result.err;
    EXPECT_EQ(runs_of(place, "out").at("endless").at("failure"), "stopped after 1 s, the study's time_limit");
  }
}

TEST(Study, AgainstAFinerRunByProbeAndByField) {
  const Workplace place;
  write_small_case(place);
  const std::string finer = "[error.finer]\nparticles.spacing = 0.00125\n";
  place.write("probe.toml",
              study_head + "[error]\nprobe = \"length\"\nnorm = \"rms\"\n" + finer + by_spacing);
  place.write("field.toml", study_head + "[error]\nfield = \"displacement\"\n" + finer + by_spacing);
  for (const char* name : {"probe", "field"}) {
    const Result result = place.tessera({"study", std::string(name) + ".toml", "-o", "out"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto runs = runs_of(place, "out");
    const double coarse = runs.at("0.005").at("error"), fine = runs.at("0.0025").at("error");
    EXPECT_GT(fine, 0) << name;
    EXPECT_LT(fine, coarse) << name;
    EXPECT_LT(fine, 0.5) << name;
    EXPECT_EQ(result.err.find("0 of them to do") != std::string::npos, std::string(name) == "field")
        << "the runs are the same, only what is read of them differs";
  }
}

TEST(Study, BadInputIsOneLineAndLeavesNothing) {
  const Workplace place;
  write_small_case(place);
  const auto refused = [&](const std::string& text, const std::vector<std::string>& pieces) {
    place.write("study.toml", text);
    expect_error(place.tessera({"study", "study.toml", "--quiet", "-o", "out"}), pieces);
    EXPECT_FALSE(fs::exists(place / "out"));
  };
  refused(study_head + by_length + axis("a", "key = \"solver.cfll\"\nvalues = [1, 2]"),
          {"study.toml (1)", "solver.cfll", "did you mean 'cfl'"});
  refused(study_head + by_length, {"the study has no axis"});
  refused(study_head + "[error]\nexact = \"velocity\"\n" + by_spacing, {"no closed form of the velocity"});
  refused(study_head + by_length + "[[axes]]\nname = \"a\"\n", {"unknown key 'axes'", "did you mean 'axis'"});
  expect_error(place.tessera({"study", "none.toml"}), {"cannot open the study file", "none.toml"});
  place.write("study.toml", study_head + by_length + by_spacing);
  place.write("mine/notes.txt", "do not lose me");
  expect_error(place.tessera({"study", "study.toml", "--quiet", "-o", "mine"}), {"not a study's"});
}

} // namespace
} // namespace tessera::cli
