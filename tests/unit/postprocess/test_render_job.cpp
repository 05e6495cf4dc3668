#include "core/error.hpp"
#include "postprocess/child_process.hpp"
#include "postprocess/render_job.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace tessera::post {
namespace {

using test::TemporaryFolder;

TEST(RenderJob, RoundTripKeepsEverything) {
  RenderJob job;
  Drawing drawing;
  drawing.file = "/a \"b\".png";
  drawing.title = "µ";
  drawing.field = "Velocity.x";
  drawing.view = "iso";
  drawing.maximum = 1.0 / 3;
  drawing.outline = true;
  drawing.panels = {{"f.vtu", "label", NAN, 0.1, "y"}};
  job.drawings = {drawing};
  job.plots = {{"p.png", {{"t", "x", "y", true, false, {{"c", {1, 2}, {NAN, 4}, true, true}}}}}};
  const RenderJob read = render_job_from_json(to_json(job));
  const Drawing& d = read.drawings.at(0);
  EXPECT_EQ(d.file, drawing.file);
  EXPECT_EQ(d.title, "µ");
  EXPECT_EQ(d.field, drawing.field);
  EXPECT_EQ(d.view, "iso");
  EXPECT_TRUE(std::isnan(d.minimum));
  EXPECT_EQ(d.maximum, 1.0 / 3);
  EXPECT_TRUE(d.outline);
  EXPECT_TRUE(std::isnan(d.panels.at(0).time));
  EXPECT_EQ(d.panels.at(0).spacing, 0.1);
  EXPECT_EQ(d.panels.at(0).clip, "y");
  const Chart& chart = read.plots.at(0).charts.at(0);
  EXPECT_TRUE(chart.log_x);
  EXPECT_FALSE(chart.log_y);
  EXPECT_TRUE(std::isnan(chart.curves.at(0).y.at(0)));
  EXPECT_EQ(chart.curves.at(0).y.at(1), 4);
  EXPECT_TRUE(chart.curves.at(0).dots);
}

TEST(RenderJob, OtherTextIsRefused) {
  EXPECT_THROW(render_job_from_json(""), InputError);
  EXPECT_THROW(render_job_from_json("{}"), InputError);
  EXPECT_THROW(render_job_from_json(R"({"drawings": [{"file": 1}], "plots": []})"), InputError);
}

TEST(ChildProcess, OutputAndStatusComeBack) {
  const TemporaryFolder folder;
  const ChildResult result = run_child({"sh", "-c", "echo out; echo err >&2; echo $TMPDIR; exit 7"}, 10,
                                       folder / "log", folder.path());
  EXPECT_TRUE(result.started);
  EXPECT_EQ(result.exit_status, 7);
  EXPECT_EQ(test::content(folder / "log"), "out\nerr\n" + folder.path().string() + "\n");
}

TEST(ChildProcess, ASlowOneIsEndedWithItsChildren) {
  const TemporaryFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const ChildResult result =
      run_child({"sh", "-c", "sleep 60 & echo $!; wait"}, 0.3, folder / "log", folder.path());
  EXPECT_TRUE(result.timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  const int grandchild = std::stoi(test::content(folder / "log"));
  // Ended, or ended and not yet collected by init.
  const std::string status = test::content("/proc/" + std::to_string(grandchild) + "/stat");
  EXPECT_TRUE(status.empty() || status.find(") Z") != std::string::npos) << status;
}

TEST(ChildProcess, OneThatDoesNotExistIsNotStarted) {
  const TemporaryFolder folder;
  EXPECT_FALSE(run_child({"/nowhere/program"}, 10, folder / "log", folder.path()).started);
  EXPECT_TRUE(find_program("tessera-no-such-program").empty());
  EXPECT_FALSE(find_program("sh").empty());
}

} // namespace
} // namespace tessera::post
