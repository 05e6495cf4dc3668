#include "postprocess/picture.hpp"
#include "postprocess/render_job.hpp"
#include "tests/unit/postprocess/seen.hpp"
#include "tests/unit/postprocess/stored_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace tessera::post {
namespace {

using test::Seen;
using test::TemporaryFolder;

/// A progress whose notes can be read.
struct Notes {
  std::ostringstream out;
  Progress progress{out, false, false};
};

TEST(Picture, ParticlesFillTheirPart) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  Picture strain;
  strain.name = "strain";
  strain.field = "PlasticStrain";
  strain.outline = true;
  Picture cut = strain;
  cut.name = "cut";
  cut.field = "Velocity";
  cut.view = "iso";
  cut.clip = "y";
  Notes notes;
  const auto files = draw({strain, cut}, {folder.path()}, {"bar"}, folder.path(), notes.progress);
  EXPECT_EQ(notes.out.str(), "");
  ASSERT_EQ(files, (std::vector<std::filesystem::path>{folder / "strain.png", folder / "cut.png"}));
  for (const auto& file : files) {
    const Seen seen(file);
    EXPECT_GE(seen.height, 1000);
    EXPECT_GE(seen.width, 600);
    EXPECT_GT(seen.colours.size(), 500u) << "spheres are shaded";
    EXPECT_LT(seen.white, 0.93) << "the body is not tiny";
    EXPECT_GT(seen.white, 0.3) << "on white";
    EXPECT_LT(seen.left, 200) << "the body begins at the left margin";
    EXPECT_LT(seen.right, seen.width - 100) << "numbers fit beside the colour bar";
  }
}

TEST(Picture, SeveralRunsStandSideBySide) {
  const TemporaryFolder folder;
  test::store_run(folder / "a", 7e-3);
  test::store_run(folder / "b", 6e-3);
  Picture strain;
  strain.field = "PlasticStrain";
  Notes notes;
  const auto one = draw({strain}, {folder / "a"}, {"a"}, folder / "a", notes.progress);
  const auto two = draw({strain}, {folder / "a", folder / "b"}, {"a", "b"}, folder / "b", notes.progress);
  EXPECT_EQ(notes.out.str(), "");
  ASSERT_EQ(one.size() + two.size(), 2u);
  EXPECT_GT(Seen(two[0]).width, Seen(one[0]).width + 300);
}

TEST(Picture, MomentsStandSideBySideOrMove) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  Picture one, strip, moving;
  one.name = "one";
  strip.name = "strip";
  strip.frames = 5; // there are two
  moving.name = "moving";
  moving.animation = true;
  std::vector<Picture> pictures{one, strip, moving};
  for (Picture& picture : pictures)
    picture.field = "PlasticStrain";
  Notes notes;
  const std::vector<Tool> wall{{Vec3::Zero(), Vec3::UnitZ(), {}, Vec3::Zero()}};
  const auto files = draw(pictures, {folder.path()}, {"bar"}, folder.path(), notes.progress, wall);
  EXPECT_EQ(notes.out.str(), "");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_TRUE(Seen(files[0]).colours.contains({222, 222, 222})) << "the wall";
  EXPECT_GT(Seen(files[1]).width, Seen(files[0]).width);
  const std::string bytes = test::content(files[2]);
  EXPECT_NE(bytes.find("acTL"), std::string::npos);
  EXPECT_NE(bytes.find("fdAT"), std::string::npos);
  EXPECT_GT(Seen(files[2]).colours.size(), 500u) << "a still for whom it does not move";
}

TEST(Picture, TimesOutsideTheRunAreNoted) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  Picture late, early, inside;
  late.field = early.field = inside.field = "PlasticStrain";
  late.name = "late";
  late.frame = "1e-3";
  early.name = "early";
  early.times = {-1e-6, 80e-6};
  inside.name = "inside";
  inside.frame = "5e-05";
  Notes notes;
  EXPECT_EQ(draw({late, early, inside}, {folder.path()}, {}, folder.path(), notes.progress).size(), 3u);
  const std::string text = notes.out.str();
  EXPECT_NE(
      text.find("late.png: the run's frames go from 0 s to 80 µs: the last one is drawn in place of 1 ms"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("early.png"), std::string::npos) << text;
  EXPECT_EQ(text.find("inside.png"), std::string::npos) << text;
}

bool has_yellow(const Seen& seen) {
  return std::any_of(seen.colours.begin(), seen.colours.end(),
                     [](const auto& c) { return c[0] > 245 && c[1] > 220 && c[2] < 60; });
}

TEST(Picture, AFieldWithOneSideHasAOneSidedScale) {
  const TemporaryFolder folder;
  std::vector<Vec3> X;
  std::vector<double> tension, both, triaxiality, von_mises;
  for (int i = 0; i < 20; ++i) {
    X.emplace_back(0.001 * (i % 5), 0.001 * (i / 5), 0);
    tension.push_back(1e6 * i);
    both.push_back(1e6 * (i - 10));
    triaxiality.push_back(i < 5 ? 1e9 : 0.3); // without stress anything
    von_mises.push_back(i < 5 ? 0 : 1e8);
  }
  io::FrameSeries(folder.path())
      .write({0,
              0,
              X,
              {{"Pressure", 1, tension},
               {"PrincipalStress1", 1, both},
               {"Triaxiality", 1, triaxiality},
               {"VonMises", 1, von_mises}}});
  std::vector<Picture> pictures(3);
  for (std::size_t k = 0; const char* field : {"Pressure", "PrincipalStress1", "Triaxiality"}) {
    pictures[k].name = field;
    pictures[k++].field = field;
  }
  Notes notes;
  const auto files = draw(pictures, {folder.path()}, {}, folder.path(), notes.progress);
  EXPECT_EQ(notes.out.str(), "");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_TRUE(has_yellow(Seen(files[0])));
  EXPECT_FALSE(has_yellow(Seen(files[1])));
  EXPECT_TRUE(Seen(files[2]).colours.contains({150, 150, 150})) << "grey where there is no stress";
}

TEST(Picture, WithoutTheBodysShapeASkinIsParticles) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  Picture skin;
  skin.field = "PlasticStrain";
  skin.skin = true;
  Notes notes;
  ASSERT_EQ(draw({skin}, {folder.path()}, {}, folder.path(), notes.progress).size(), 1u);
  EXPECT_NE(notes.out.str().find("there is no body.vtu"), std::string::npos) << notes.out.str();
}

TEST(Picture, CloudIsDrawnFromItsFile) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  const auto files = draw_cloud(folder.path(), Progress::silent());
  ASSERT_EQ(files, std::vector<std::filesystem::path>{folder / "cloud.png"});
  EXPECT_GT(Seen(files[0]).colours.size(), 500u);
}

TEST(Picture, APlaneBodyIsSeenFromAbove) {
  const TemporaryFolder folder;
  std::vector<Vec3> X;
  std::vector<double> p;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 40; ++i) {
      X.emplace_back(0.001 * i, 0.001 * j, 0);
      p.push_back(0); // and a field of one value has a scale, too
    }
  io::FrameSeries(folder.path()).write({0, 0, X, {{"Pressure", 1, p}}});
  Picture pressure;
  pressure.name = "pressure";
  pressure.field = "Pressure";
  pressure.clip = "y";
  Notes notes;
  const auto files = draw({pressure}, {folder.path()}, {}, folder.path(), notes.progress);
  EXPECT_EQ(notes.out.str(), "");
  ASSERT_EQ(files.size(), 1u);
  EXPECT_GT(Seen(files[0]).width, 2 * Seen(files[0]).height) << "a long body makes a wide picture";
}

TEST(Picture, WhatCannotBeDrawnIsNotedAndTheOthersAreDrawn) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  Picture wrong, stress, right;
  wrong.name = "wrong";
  wrong.field = "Temperature";
  stress.name = "tensor";
  stress.field = "Stress";
  right.name = "right";
  right.field = "Stress.zz";
  Notes notes;
  const auto files = draw({wrong, stress, right}, {folder.path()}, {}, folder.path(), notes.progress);
  EXPECT_EQ(files, std::vector<std::filesystem::path>{folder / "right.png"});
  EXPECT_NE(notes.out.str().find("no wrong.png: no field 'Temperature'"), std::string::npos)
      << notes.out.str();
  EXPECT_NE(notes.out.str().find("PlasticStrain"), std::string::npos) << "the fields there are";
  EXPECT_NE(notes.out.str().find("Stress.xx"), std::string::npos) << notes.out.str();
}

TEST(Picture, DamagedFramesAndMissingSeriesAreNoted) {
  const TemporaryFolder folder;
  Picture strain;
  strain.field = "PlasticStrain";
  Notes notes;
  EXPECT_TRUE(draw({strain}, {folder.path()}, {}, folder.path(), notes.progress).empty());
  EXPECT_NE(notes.out.str().find("no stored fields"), std::string::npos) << notes.out.str();
  test::store_run(folder.path(), 7e-3);
  const auto frame = folder / "fields/fields_0001.vtu";
  test::store(frame, test::content(frame).substr(0, 3000));
  EXPECT_TRUE(draw({strain}, {folder.path()}, {}, folder.path(), notes.progress).empty());
  EXPECT_NE(notes.out.str().find("fields_0001.vtu"), std::string::npos) << notes.out.str();
}

/// Sets an environment variable until the end of the scope.
class Setting {
 public:
  Setting(const char* name, const char* value)
      : name_(name), before_(std::getenv(name) ? std::getenv(name) : "") {
    ::setenv(name, value, 1);
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;
  ~Setting() { before_.empty() ? ::unsetenv(name_) : ::setenv(name_, before_.c_str(), 1); }

 private:
  const char* name_;
  std::string before_;
};

TEST(Picture, WithoutXvfbThereIsANoteAndNoFile) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  Notes notes;
  const Setting path("PATH", folder.path().c_str());
  EXPECT_TRUE(draw_cloud(folder.path(), notes.progress).empty());
  EXPECT_NE(notes.out.str().find("xvfb-run is not installed"), std::string::npos) << notes.out.str();
  EXPECT_FALSE(std::filesystem::exists(folder / "cloud.png"));
}

TEST(Picture, ARendererThatIsNotThereOrFailsIsNoted) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 7e-3);
  Notes notes;
  const Setting libexec("TESSERA_LIBEXEC", folder.path().c_str());
  EXPECT_TRUE(draw_cloud(folder.path(), notes.progress).empty());
  EXPECT_NE(notes.out.str().find("TESSERA_LIBEXEC"), std::string::npos) << notes.out.str();
  test::store(folder / "tessera-render", "#!/bin/sh\necho the card is on fire >&2\nexit 3\n");
  std::filesystem::permissions(folder / "tessera-render", std::filesystem::perms::owner_all);
  EXPECT_TRUE(draw_cloud(folder.path(), notes.progress).empty());
  EXPECT_NE(notes.out.str().find("the card is on fire"), std::string::npos) << notes.out.str();
}

TEST(Plot, CurvesAreDrawnAndOddValuesLeftOut) {
  const TemporaryFolder folder;
  Chart chart{"Errors", "Time (s)", "Error (-)", true, true, {}};
  chart.curves.push_back({"first", {1, 10, 100, 0}, {1, 0.1, NAN, 1}, false, false});
  chart.curves.push_back({"second", {1, 10, 100}, {2, 0.5, 0.02}, true, false});
  chart.curves.push_back({"none", {}, {}, false, true});
  Chart constant{"Constant", "x", "y", false, false, {{"", {0, 1}, {5, 5}, false, false}}};
  Notes notes;
  const auto files = render({{}, {{(folder / "p.png").string(), {chart, constant}}}}, notes.progress);
  EXPECT_EQ(notes.out.str(), "");
  ASSERT_EQ(files.size(), 1u);
  const Seen seen(files[0]);
  EXPECT_EQ(seen.width, 1600);
  EXPECT_EQ(seen.height, 1600);
  EXPECT_TRUE(seen.colours.contains({0, 90, 181}));
  EXPECT_TRUE(seen.colours.contains({220, 50, 32}));
}

TEST(CellChart, EachKindHasItsColour) {
  using Cell = CellChart::Cell;
  const TemporaryFolder folder;
  CellChart chart{(folder / "c.png").string(), "Title",  "rows",   "columns", {"a"},
                  {"1", "2", "3", "4"},        "within", "beyond", "failed",  {}};
  chart.panels.push_back({"panel",
                          {{Cell::Kind::within, -2, "0.1 %"},
                           {Cell::Kind::beyond, 5, "1e+06 %"},
                           {Cell::Kind::failed, 0, "unstable"},
                           {Cell::Kind::blank, 0, "-"}}});
  Notes notes;
  const auto files = render({{}, {}, {chart}}, notes.progress);
  EXPECT_EQ(notes.out.str(), "");
  ASSERT_EQ(files.size(), 1u);
  const Seen one(files[0]);
  for (const std::array<int, 3>& colour : {std::array{86, 158, 220}, std::array{226, 110, 40},
                                           std::array{52, 48, 62}, std::array{236, 236, 236}})
    EXPECT_TRUE(one.colours.contains(colour)) << colour[0];

  // Panels stand beside each other as long as there is room, then below.
  chart.panels.resize(3, chart.panels.front());
  ASSERT_EQ(render({{}, {}, {chart}}, notes.progress).size(), 1u);
  const Seen beside(files[0]);
  EXPECT_EQ(beside.height, one.height);
  EXPECT_GT(beside.width, one.width);
  chart.panels.resize(9, chart.panels.front());
  ASSERT_EQ(render({{}, {}, {chart}}, notes.progress).size(), 1u);
  const Seen below(files[0]);
  EXPECT_GT(below.height, one.height);
  EXPECT_LE(below.width, 2400);
}

} // namespace
} // namespace tessera::post
