#include "app/study/content_hash.hpp"
#include "app/study/grid.hpp"
#include "app/study/plan.hpp"
#include "app/study/study_file.hpp"
#include "core/error.hpp"
#include "tests/unit/app/case_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace tessera::app {
namespace {

const std::string complete_study = R"(title = "a study"
case = "case.toml"
[common]
solver.end_time = 1e-6
[error]
probe = "length"
value = 0.03
[[axis]]
name = "cloud"
values = [
  {label = "lattice", particles.arrangement = "lattice"},
  {label = "raw", particles.arrangement = "voronoi", solver.scheme = "thesis"},
]
[[axis]]
name = "size"
key = "particles.count"
values = [100, 200, 400]
[[exclude]]
cloud = "raw"
size = [200, 400]
)";

std::string study_with(const std::string& from, const std::string& to) {
  std::string text = complete_study;
  const std::size_t at = text.find(from);
  if (at == std::string::npos)
    throw std::logic_error("the complete study has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

/// A folder with a case of a built-in shape, and studies of it.
class StudyFile : public testing::Test {
 protected:
  StudyFile() {
    folder.file("case.toml", with("file = \"bar.step\"\nunit = \"mm\"", "shape = \"box\"\nsize = [1, 1, 1]"));
  }
  Study read(const std::string& text) const { return read_study(folder.file("study.toml", text)); }
  Plan plan(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return plan_study(read(text), overrides);
  }
  /// The one-line complaint about `text`, with the folder's name cut off.
  std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    try {
      plan(text, overrides);
    } catch (const InputError& e) {
      std::string line = e.what();
      const std::string prefix = folder.path().string() + "/";
      for (std::size_t at = line.find(prefix); at != std::string::npos; at = line.find(prefix))
        line.erase(at, prefix.size());
      return line;
    }
    return "no error";
  }
  void expect_complaint(const std::string& text, const std::vector<std::string>& pieces) const {
    const std::string line = complaint(text);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 0) << line;
    for (const std::string& piece : pieces)
      EXPECT_NE(line.find(piece), std::string::npos) << "'" << piece << "' is not in: " << line;
  }
  CaseFolder folder;
};

TEST_F(StudyFile, AxesBecomeAssignments) {
  const Study study = read(complete_study);
  EXPECT_EQ(study.title, "a study");
  EXPECT_EQ(study.common, std::vector<std::string>{"solver.end_time=1e-06"});
  ASSERT_EQ(study.axes.size(), 2U);
  ASSERT_EQ(study.axes[0].values.size(), 2U);
  EXPECT_EQ(study.axes[0].values[1].label, "raw");
  EXPECT_EQ(study.axes[0].values[1].assignments,
            (std::vector<std::string>{"particles.arrangement='voronoi'", "solver.scheme='thesis'"}));
  EXPECT_EQ(study.axes[1].values[2].label, "400");
  EXPECT_EQ(study.axes[1].values[2].assignments, std::vector<std::string>{"particles.count=400"});
  EXPECT_EQ(study.error.targets.front(), 0.1);
  EXPECT_EQ(study.colour, "cloud");
  EXPECT_EQ(study.error.value, 0.03);
}

TEST_F(StudyFile, ThoseOfTheProjectAreValid) {
  const std::filesystem::path project = TESSERA_SOURCE_DIR;
  int studies = 0, maps = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(project / "geometries"))
    if (entry.path().filename() == "study.toml") {
      ++studies;
      EXPECT_NO_THROW(plan_study(read_study(entry.path()), {})) << entry.path();
    }
  for (const auto& entry : std::filesystem::directory_iterator(project / "docs/maps"))
    if (entry.path().extension() == ".toml") {
      ++maps;
      EXPECT_NO_THROW(plan_study(read_study(entry.path()), {})) << entry.path();
    }
  EXPECT_GE(studies, 3);
  EXPECT_GE(maps, 5);
}

TEST_F(StudyFile, MapOfTwoAxesOrAsAsked) {
  const Study plain = read(complete_study);
  EXPECT_TRUE(plain.map.drawn);
  EXPECT_EQ(plain.map.rows, "cloud");
  EXPECT_EQ(plain.map.columns, "size");
  EXPECT_EQ(plain.map.inaccurate, plain.error.targets.front());
  const std::string before = "[[axis]]\nname = \"cloud\"";
  const auto with_map = [&](const std::string& map) { return study_with(before, map + before); };
  const Study asked =
      read(with_map("[map]\nrows = \"size\"\ncolumns = \"cloud\"\ninaccurate = 0.02\nunbalanced = 0.5\n"));
  EXPECT_EQ(asked.map.rows, "size");
  EXPECT_EQ(asked.map.columns, "cloud");
  EXPECT_EQ(asked.map.inaccurate, 0.02);
  EXPECT_EQ(asked.map.unbalanced, 0.5);
  const std::string third = "[[axis]]\nname = \"step\"\nkey = \"solver.cfl\"\nvalues = [0.5, 0.8]\n";
  EXPECT_FALSE(read(study_with(before, third + before)).map.drawn);
  EXPECT_TRUE(read(study_with(before, "[map]\n" + third + before)).map.drawn);

  expect_complaint(with_map("[map]\nrows = \"sise\"\n"),
                   {"study.toml:9", "no axis 'sise'", "did you mean 'size'"});
  expect_complaint(with_map("[map]\nrows = \"size\"\n"), {"rows and columns", "'size'", "name two axes"});
  expect_complaint(with_map("[map]\ninaccurate = 0\n"), {"map.inaccurate", "greater than 0"});
  expect_complaint(with_map("[map]\ncolour = 1\n"), {"map.colour"});
  const std::size_t second = complete_study.rfind("[[axis]]");
  expect_complaint(complete_study.substr(0, second) + "[map]\n",
                   {"the study has one axis", "add an [[axis]]"});
}

TEST_F(StudyFile, GridIsEveryCombinationButTheExcluded) {
  std::vector<std::string> words;
  for (const GridPoint& point : expand_grid(read(complete_study)))
    words.push_back(point.labels[0] + " " + point.labels[1]);
  EXPECT_EQ(words, (std::vector<std::string>{"lattice 100", "lattice 200", "lattice 400", "raw 100"}));

  Study large = read(complete_study);
  large.exclude.clear();
  const Axis axis = large.axes[1];
  for (int i = 0; i < 8; ++i)
    large.axes.push_back(axis);
  EXPECT_THROW(expand_grid(large), InputError);
  Study none = read(complete_study);
  none.exclude = {{{"cloud", {"lattice", "raw"}}}};
  EXPECT_THROW(expand_grid(none), InputError);
}

TEST_F(StudyFile, IdIsOfTheContent) {
  const Plan first = plan(complete_study);
  ASSERT_EQ(first.runs.size(), 4U);
  EXPECT_EQ(first.column, "length_m");
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_NE(first.runs[a].id, first.runs[b].id);
  // Another label, another title, another grid around it: the same run.
  const Plan renamed = plan(study_with("label = \"lattice\"", "label = \"regular\""));
  EXPECT_EQ(renamed.runs[0].id, first.runs[0].id);
  EXPECT_EQ(plan(study_with("values = [100, 200, 400]", "values = [400, 100, 200]")).runs[0].id,
            first.runs[2].id);
  EXPECT_NE(plan(study_with("end_time = 1e-6", "end_time = 2e-6")).runs[0].id, first.runs[0].id);
  EXPECT_NE(plan(complete_study, {"particles.seed=7"}).runs[0].id, first.runs[0].id);
  EXPECT_GT(first.runs[2].work, first.runs[0].work) << "more particles are more work";
}

TEST_F(StudyFile, IdIsOfTheFilesItReads) {
  folder.file("bar.step", "one body");
  folder.file("case.toml", complete_case);
  const std::string before = plan(complete_study).runs[0].id;
  EXPECT_EQ(plan(complete_study).runs[0].id, before);
  folder.file("bar.step", "another body");
  EXPECT_NE(plan(complete_study).runs[0].id, before);
}

TEST_F(StudyFile, FinerRunIsPlannedToo) {
  const Plan finer = plan(study_with("value = 0.03", "finer = {particles.count = 5000}"));
  ASSERT_TRUE(finer.finer.has_value());
  EXPECT_NE(finer.finer->text.find("5000"), std::string::npos);
  EXPECT_GT(finer.finer->work, finer.runs[2].work);
}

TEST_F(StudyFile, BadStudiesAreOneLine) {
  expect_complaint(study_with("title", "titel"),
                   {"study.toml:1:1", "'titel'", "did you mean 'title'", "of a study"});
  expect_complaint(study_with("case.toml", "none.toml"),
                   {"study.toml:2", "none.toml", "relative to the study"});
  expect_complaint(study_with("key = \"particles.count\"", "key = \"particles.cuont\""),
                   {"study.toml (lattice, 100)", "particles.cuont", "did you mean 'count'"});
  expect_complaint(study_with("solver.scheme = \"thesis\"", "solver.scheme = \"thesus\""),
                   {"(raw, 100)", "thesus", "thesis"});
  expect_complaint(study_with("solver.scheme = \"thesis\"", "particles.count = 5"),
                   {"'cloud' and 'size' both set particles.count"});
  expect_complaint(study_with("[common]", "[common]\nparticles.count = 5"),
                   {"particles.count does nothing", "every value of axis 'size'"});
  expect_complaint(study_with("probe = \"length\"", "probe = \"lenght\""),
                   {"lenght", "did you mean 'length'"});
  expect_complaint(study_with("probe = \"length\"\nvalue = 0.03", "exact = \"velocity\""),
                   {"no closed form of the velocity", "[exact]"});
  expect_complaint(study_with("value = 0.03\n", ""), {"error has 0 references", "history"});
  expect_complaint(study_with("value = 0.03", "value = 0.03\ntagrets = [1]"),
                   {"study.toml:8:1", "'error.tagrets'", "did you mean 'targets'"});
  expect_complaint(study_with("value = 0.03", "value = 0.03\ntargets = [0]"), {"a target is 0"});
  expect_complaint(study_with("value = 0.03", "value = 0"), {"study.toml:7", "relative"});
  expect_complaint(study_with("value = 0.03", "value = 1\nnorm = \"rms\""), {"error.norm does nothing"});
  expect_complaint(study_with("value = 0.03", "history = {file = \"h.csv\", column = \"x\"}"), {"h.csv"});
  expect_complaint(study_with("cloud = \"raw\"", "clod = \"raw\""),
                   {"no axis 'clod'", "did you mean 'cloud'"});
  expect_complaint(study_with("cloud = \"raw\"", "cloud = \"rau\""),
                   {"no value 'rau'", "did you mean 'raw'"});
  expect_complaint(study_with("name = \"size\"", "name = \"cloud\""), {"two axes are called 'cloud'"});
  expect_complaint(study_with("name = \"size\"", "name = \"steps\""), {"may not be called 'steps'"});
  expect_complaint(study_with("label = \"raw\"", "label = \"lattice\""), {"two values called 'lattice'"});
  expect_complaint(study_with("values = [100, 200, 400]", "values = []"), {"axis.1.values"});
  EXPECT_NE(complaint(complete_study, {"particles.count=5"}).find("axis 'size' of the study sets"),
            std::string::npos);
}

TEST(ContentHash, KnowsPiecesApart) {
  const auto of = [](const std::vector<std::string>& pieces) {
    ContentHash hash;
    for (const std::string& piece : pieces)
      hash.add(piece);
    return hash.text();
  };
  EXPECT_EQ(of({"ab", "c"}), of({"ab", "c"}));
  EXPECT_NE(of({"ab", "c"}), of({"a", "bc"}));
  EXPECT_NE(of({"ab", "c"}), of({"abc"}));
  EXPECT_EQ(of({"x"}).size(), 16U);
}

} // namespace
} // namespace tessera::app
