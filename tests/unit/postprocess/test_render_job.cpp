#include "core/error.hpp"
#include "postprocess/render_job.hpp"
#include "tests/support/temporary_folder.hpp"

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
  drawing.cloud = true;
  drawing.skin = true;
  drawing.one_by_one = true;
  drawing.tools = {{{1, 2, 3}, {0, 1, 0}, {{4, 5, 0}, {6, 7, 0}}, {0, 0, -1}}};
  drawing.panels = {{"f.vtu", "label", NAN, 0.1, "y", "c.vtu", "b.vtu", "p.vtp", 0.25}};
  job.drawings = {drawing};
  job.plots = {
      {"p.png", {{"t", "x", "y", true, false, {{"c", {1, 2}, {NAN, 4}, true, true, true, 3, 2}}}}, true}};
  job.cell_charts = {
      {"m.png",
       "t",
       "r",
       "c",
       {"a"},
       {"b", "d"},
       "good",
       "poor",
       "bad",
       {{"p", {{CellChart::Cell::Kind::within, -1.5, "1 %"}, {CellChart::Cell::Kind::failed, 0, "x"}}}}}};
  const RenderJob read = render_job_from_json(to_json(job));
  const Drawing& d = read.drawings.at(0);
  EXPECT_EQ(d.file, drawing.file);
  EXPECT_EQ(d.title, "µ");
  EXPECT_EQ(d.field, drawing.field);
  EXPECT_EQ(d.view, "iso");
  EXPECT_TRUE(std::isnan(d.minimum));
  EXPECT_EQ(d.maximum, 1.0 / 3);
  EXPECT_TRUE(d.outline);
  EXPECT_TRUE(d.cloud);
  EXPECT_TRUE(d.skin);
  EXPECT_FALSE(d.one_place);
  EXPECT_TRUE(d.one_by_one);
  EXPECT_EQ(d.tools.at(0).point, Vec3(1, 2, 3));
  EXPECT_EQ(d.tools.at(0).normal, Vec3(0, 1, 0));
  EXPECT_EQ(d.tools.at(0).line.at(1), Vec3(6, 7, 0));
  EXPECT_EQ(d.tools.at(0).velocity, Vec3(0, 0, -1));
  EXPECT_EQ(d.panels.at(0).body, "b.vtu");
  EXPECT_EQ(d.panels.at(0).cloud, "p.vtp");
  EXPECT_EQ(d.panels.at(0).clip_at, 0.25);
  EXPECT_EQ(d.panels.at(0).cells, "c.vtu");
  EXPECT_TRUE(std::isnan(d.panels.at(0).time));
  EXPECT_EQ(d.panels.at(0).spacing, 0.1);
  EXPECT_EQ(d.panels.at(0).clip, "y");
  const Chart& chart = read.plots.at(0).charts.at(0);
  EXPECT_TRUE(chart.log_x);
  EXPECT_FALSE(chart.log_y);
  EXPECT_TRUE(std::isnan(chart.curves.at(0).y.at(0)));
  EXPECT_EQ(chart.curves.at(0).y.at(1), 4);
  EXPECT_TRUE(chart.curves.at(0).bars);
  EXPECT_TRUE(read.plots.at(0).beside);
  EXPECT_TRUE(chart.curves.at(0).dots);
  EXPECT_EQ(chart.curves.at(0).colour, 3);
  EXPECT_EQ(chart.curves.at(0).marker, 2);
  const CellChart& cells = read.cell_charts.at(0);
  EXPECT_EQ(cells.row_title, "r");
  EXPECT_EQ(cells.column_title, "c");
  EXPECT_EQ(cells.columns, (std::vector<std::string>{"b", "d"}));
  EXPECT_EQ(cells.beyond, "poor");
  EXPECT_EQ(cells.panels.at(0).title, "p");
  EXPECT_EQ(cells.panels.at(0).cells.at(0).kind, CellChart::Cell::Kind::within);
  EXPECT_EQ(cells.panels.at(0).cells.at(0).decades, -1.5);
  EXPECT_EQ(cells.panels.at(0).cells.at(1).words, "x");
}

TEST(RenderJob, CellsThatDoNotFillTheirRowsAreRefused) {
  RenderJob job;
  job.cell_charts = {{"m.png", "t", "r", "c", {"a"}, {"b", "d"}, "", "", "", {{"p", {{}}}}}};
  EXPECT_THROW(render_job_from_json(to_json(job)), InputError);
}

TEST(RenderJob, OtherTextIsRefused) {
  EXPECT_THROW(render_job_from_json(""), InputError);
  EXPECT_THROW(render_job_from_json("{}"), InputError);
  EXPECT_THROW(render_job_from_json(R"({"drawings": [{"file": 1}], "plots": []})"), InputError);
}

} // namespace
} // namespace tessera::post
