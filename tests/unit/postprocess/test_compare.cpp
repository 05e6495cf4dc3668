#include "core/error.hpp"
#include "postprocess/compare.hpp"
#include "postprocess/report.hpp"
#include "tests/unit/postprocess/stored_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tessera::post {
namespace {

using test::contains;
using test::content;
using test::TemporaryFolder;

std::vector<std::string> row(const Comparison& comparison, const std::string& name) {
  const auto found = std::find(comparison.rows.begin(), comparison.rows.end(), name);
  if (found == comparison.rows.end())
    return {};
  return comparison.values[static_cast<std::size_t>(found - comparison.rows.begin())];
}

using Values = std::vector<std::string>;

TEST(Compare, TheSameNumbersStandBesideEachOther) {
  const TemporaryFolder folder;
  test::store_run(folder / "lattice", 6.98e-3);
  test::store_run(folder / "voronoi", 7.2251234e-3, R"(, "error": {"l2_velocity_relative": 0.0405})");
  const Comparison comparison =
      compare({folder / "lattice", folder / "voronoi/"}, folder / "out/both", Progress::silent());
  EXPECT_EQ(comparison.runs, (Values{"lattice", "voronoi"}));
  EXPECT_EQ(row(comparison, "Radius (mm)"), (Values{"6.98", "7.2251"}));
  EXPECT_EQ(row(comparison, "Particles"), (Values{"4131", "4131"}));
  EXPECT_EQ(row(comparison, "Seed"), (Values{"18446744073709551615", "18446744073709551615"}));
  EXPECT_EQ(row(comparison, "Spacing (mm)"), (Values{"0.64", "0.64"}));
  EXPECT_EQ(row(comparison, "Wall time (s)"), (Values{"12.25", "12.25"}));
  EXPECT_EQ(row(comparison, "Largest von Mises stress (MPa)"), (Values{"650", "650"}));
  EXPECT_EQ(row(comparison, "Size along z (mm)"), (Values{"21.5", "21.5"}));
  EXPECT_EQ(row(comparison, "Velocity error, L2 relative"), (Values{"-", "0.0405"}));
  EXPECT_TRUE(row(comparison, "Neighbours, mean").empty()) << "no run has it";
  for (const char* name : {"compare.csv", "compare.json", "compare.md", "compare.html", "compare_probes.png",
                           "compare_plastic_strain.png", "compare_von_mises.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "out/both" / name)) << name;
    EXPECT_EQ(std::count(comparison.files.begin(), comparison.files.end(), folder / "out/both" / name), 1)
        << name;
  }
  EXPECT_TRUE(
      contains(content(folder / "out/both/compare.csv"), "probes.radius_m,Radius,m,0.00698,0.0072251234"));
  EXPECT_TRUE(contains(content(folder / "out/both/compare.csv"),
                       "error.l2_velocity_relative,\"Velocity error, L2 relative\",,,0.0405"));
  EXPECT_TRUE(contains(content(folder / "out/both/compare.md"), "| Radius (mm) | 6.98 | 7.2251 |"));
  EXPECT_TRUE(contains(content(folder / "out/both/compare.md"), "![compare_probes](compare_probes.png)"));
  const std::string json = content(folder / "out/both/compare.json");
  EXPECT_TRUE(contains(json, "0.0072251234"));
  EXPECT_TRUE(contains(json, "18446744073709551615"));
  EXPECT_TRUE(contains(json, "null"));
}

TEST(Compare, ColumnsOfTheTableStandUnderTheirNames) {
  const Comparison comparison{{"a", "longer"}, {"Radius (µm)", "Time"}, {{"1", "2.5"}, {"-", "3"}}, {}};
  EXPECT_EQ(table(comparison), "             a  longer\n"
                               "Radius (µm)  1     2.5\n"
                               "Time         -       3\n");
}

TEST(Compare, EqualFolderNamesAreMadeDistinct) {
  const TemporaryFolder folder;
  for (const char* name : {"a/bar", "b/bar"})
    test::store_run(folder / name, 7e-3);
  for (const char* name : {"a/bar", "b/bar"})
    std::filesystem::remove(folder / name / "fields.pvd");
  const Comparison comparison =
      compare({folder / "a/bar", folder / "b/bar", folder / "b/bar"}, folder / "out", Progress::silent());
  EXPECT_EQ(comparison.runs, (Values{"a/bar", "b/bar", "b/bar (2)"}));
}

TEST(Compare, AFolderWithoutARunIsNamedWithTheRemedy) {
  const TemporaryFolder folder;
  test::store_run(folder / "good", 7e-3);
  try {
    compare({folder / "good", folder / "empty"}, folder / "out", Progress::silent());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), (folder / "empty").string())) << error.what();
    EXPECT_TRUE(contains(error.what(), "tessera run")) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out")) << "nothing is written before all inputs are good";
  test::store(folder / "good/summary.json", "{\"case\": ");
  EXPECT_THROW(compare({folder / "good"}, folder / "out", Progress::silent()), InputError);
}

TEST(Report, TellsTheFiguresAndShowsThePictures) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 6.98e-3);
  test::store(folder / "my picture.png", "not looked into");
  const auto files = write_report(folder.path(), Progress::silent());
  EXPECT_EQ(files.size(), 5u);
  for (const char* name : {"energies.png", "probes.png", "cloud_histograms.png", "report.md", "report.html"})
    EXPECT_EQ(std::count(files.begin(), files.end(), folder / name), 1) << name;
  const std::string text = content(folder / "report.md");
  EXPECT_TRUE(contains(text, "# Taylor bar\n"));
  EXPECT_TRUE(contains(text, "| Radius | 6.98 mm |")) << text;
  EXPECT_TRUE(contains(text, "| Largest von Mises stress | 650 MPa |")) << text;
  EXPECT_TRUE(contains(text, "| Particles in set 'base' | 81 |")) << text;
  EXPECT_TRUE(contains(text, "![my picture](my%20picture.png)")) << text;
  EXPECT_TRUE(contains(text, "![energies](energies.png)")) << text;
  EXPECT_TRUE(contains(text, "paraview fields.pvd")) << text;
  EXPECT_TRUE(contains(text, "*Gaussian Radius* 0.00032")) << text;
  EXPECT_TRUE(contains(text, "### Energies")) << text;
}

TEST(Report, AnUnfinishedRunHasOneToo) {
  const TemporaryFolder folder;
  test::store_run(folder.path(), 6.98e-3);
  std::filesystem::remove(folder / "summary.json");
  test::store(folder / "history.csv", content(folder / "history.csv") + "0.1,2");
  const auto files = write_report(folder.path(), Progress::silent());
  EXPECT_EQ(files.size(), 5u);
  EXPECT_TRUE(contains(content(folder / "report.md"), "did not reach its end"));
}

TEST(Report, AnEmptyFolderIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_report(folder.path(), Progress::silent()), InputError);
}

} // namespace
} // namespace tessera::post
