#include "tests/architecture/include_arrows.hpp"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

namespace tessera::architecture {
namespace {

namespace fs = std::filesystem;

/// A source tree made for one test.
class IncludeArrows : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / fmt::format("tessera-arrows-{}", ::getpid());
    fs::remove_all(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  void add(const std::string& file, const std::string& line) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << "// first line\n" << line << '\n';
  }
  std::vector<std::string> found() const { return violations(root_); }

  fs::path root_;
};

TEST_F(IncludeArrows, AreKeptByThisProject) {
  const fs::path project = TESSERA_SOURCE_DIR;
  EXPECT_GE(source_files(project).size(), 50U) << "the test looks at the wrong folder";
  EXPECT_TRUE(violations(project).empty()) << fmt::format("{}", fmt::join(violations(project), "\n"));
}

TEST_F(IncludeArrows, AllowWhatPointsAlongThem) {
  add("core/a.cpp", "#include \"core/a.hpp\"");
  add("solver/scene/a.cpp", "#include \"solver/operators/a.hpp\"");
  add("postprocess/a.cpp", "#include \"io/a.hpp\"");
  add("postprocess/b.cpp", "#include <vtkPoints.h>");
  add("preprocess/a.cpp", "#include <CGAL/Delaunay_triangulation_3.h>");
  add("app/a.cpp", "#include <toml++/toml.h>");
  EXPECT_TRUE(found().empty()) << fmt::format("{}", fmt::join(found(), "\n"));
}

TEST_F(IncludeArrows, NameFileLineAndBothEnds) {
  add("solver/scene/a.cpp", "#include \"io/field_series.hpp\"");
  EXPECT_EQ(found(), std::vector<std::string>{
                         "solver/scene/a.cpp:2: solver may not include io ('io/field_series.hpp')"});
}

TEST_F(IncludeArrows, EveryWrongDirectionIsFound) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"core/a.hpp", "#include \"solver/scene/scene.hpp\""},
      {"core/b.hpp", "#include \"io/field_series.hpp\""},
      {"preprocess/a.cpp", "#include \"solver/scene/scene.hpp\""},
      {"io/a.cpp", "#include \"preprocess/geometry/domain.hpp\""},
      {"postprocess/a.cpp", "#include \"app/options.hpp\""},
      {"solver/operators/a.hpp", "#include \"solver/physics/strain.hpp\""},
      {"solver/physics/a.hpp", "#include \"solver/boundary/wall.hpp\""},
      {"solver/boundary/a.hpp", "#include \"solver/time/step.hpp\""},
      {"solver/time/a.hpp", "  #  include \"solver/scene/scene.hpp\""},
      {"solver/operators/b.hpp", "#include \"neighbours.hpp\""},
      {"solver/scene/a.cpp", "#include <vtkPoints.h>"},
      {"core/c.cpp", "#include <hdf5.h>"},
      {"preprocess/b.cpp", "#include <vtkPoints.h>"},
      {"solver/scene/b.cpp", "#include <CGAL/Epick_d.h>"},
      {"io/b.cpp", "#include <gmsh.h>"},
      {"postprocess/b.cpp", "#include <voro++/voro++.hh>"},
      {"solver/scene/c.cpp", "#include <toml++/toml.h>"},
      {"io/c.cpp", "#include <CLI/CLI.hpp>"}};
  for (const auto& [file, line] : wrong) {
    fs::remove_all(root_);
    add(file, line);
    EXPECT_EQ(found().size(), 1U) << file << " with " << line;
  }
}

} // namespace
} // namespace tessera::architecture
