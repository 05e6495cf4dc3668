// Damaged files through the import as the program does it: whatever they hold, the program lives, says what
// is wrong in one line, keeps to its time and leaves nothing behind.
#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "preprocess/geometry/import.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/support/domains.hpp"
#include "tests/unit/preprocess/geometry/iges_box.hpp"
#include "tests/unit/preprocess/geometry/mesh_files.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace tessera::preprocess {
namespace {

namespace fs = std::filesystem;

constexpr double seconds_allowed = 5, seconds_to_end = 3;

class ImportMutations : public testing::Test {
 protected:
  ImportMutations() {
    const char* old = std::getenv("TMPDIR");
    had_old_ = old != nullptr;
    old_ = had_old_ ? old : "";
    fs::create_directory(temporary());
    ::setenv("TMPDIR", temporary().c_str(), 1);
  }
  ~ImportMutations() override {
    if (had_old_)
      ::setenv("TMPDIR", old_.c_str(), 1);
    else
      ::unsetenv("TMPDIR");
  }

  /// Imports `count` mutations of a file.
  void survive(const std::string& name, const std::string& original, int count, std::uint64_t seed,
               int dimension = 3) {
    GeometrySource source{.file = folder_.path() / name, .unit = "mm"};
    source.dimension = dimension;
    source.tolerance = 2e-2;
    source.seconds = seconds_allowed;
    source.bytes = std::uint64_t{1} << 30;
    write(source.file, original);
    ASSERT_NO_THROW(import_geometry(source, Progress::silent())) << "the file itself is good";
    int imported = 0, crashed = 0, late = 0;
    double slowest = 0;
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE("mutation " + std::to_string(seed + static_cast<std::uint64_t>(i)) + " of " + name);
      write(source.file, test::mutate(original, seed + static_cast<std::uint64_t>(i)));
      const auto start = std::chrono::steady_clock::now();
      try {
        const Domain domain = import_geometry(source, Progress::silent());
        EXPECT_NO_THROW(domain.validate(name));
        ++imported;
      } catch (const InputError& error) {
        const std::string said = error.what();
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        const auto where = said.find(name);
        EXPECT_NE(where, std::string::npos) << said;
        EXPECT_NE(said.find(", ", where), std::string::npos) << "no remedy: " << said;
        EXPECT_LT(said.size(), 1000u) << said;
        crashed += said.find("crashed") != std::string::npos ? 1 : 0;
        late += said.find("longer than its limit") != std::string::npos ? 1 : 0;
      } catch (const std::exception& error) {
        ADD_FAILURE() << "not the file's fault? " << error.what();
      }
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      slowest = std::max(slowest, took.count());
      EXPECT_LT(took.count(), seconds_allowed + seconds_to_end);
      EXPECT_TRUE(fs::is_empty(temporary())) << "something was left behind";
    }
    std::cout << name << ": " << count << " mutations, " << imported << " imported, " << crashed
              << " crashed the kernel, " << late << " ran out of time, slowest " << slowest << " s\n";
    EXPECT_LT(imported, count); // the mutations do harm
  }

 private:
  fs::path temporary() const { return folder_.path() / "temporary"; }
  static void write(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  }
  TemporaryFolder folder_;
  bool had_old_;
  std::string old_;
};

std::string part(const char* name) {
  std::ostringstream text;
  text << std::ifstream(fs::path(TESSERA_SOURCE_DIR) / "geometries" / name, std::ios::binary).rdbuf();
  return text.str();
}

TEST_F(ImportMutations, step_cylinder) {
  survive("bar.step", part("taylor_bar/taylor_bar.step"), 60, 1000);
}

TEST_F(ImportMutations, step_bracket) {
  survive("bracket.step", part("bracket/bracket.step"), 40, 2000);
}

TEST_F(ImportMutations, msh) {
  survive("part.msh", test::msh2(test::l_domain(2), true), 70, 3000);
  survive("bare.msh", test::msh2(test::box_domain(), false), 30, 4000);
}

TEST_F(ImportMutations, stl) {
  survive("text.stl", test::text_stl(test::l_domain(1)), 60, 5000);
  survive("binary.stl", test::binary_stl(test::l_domain(2)), 40, 6000);
}

TEST_F(ImportMutations, iges_obj_ply) {
  survive("box.igs", test::iges_box({1, 2, 3}), 15, 7000);
  survive("lid.igs", test::iges_box({1, 2, 3}, 6, 2, "MM", 5), 5, 8000, 2);
  survive("part.obj", test::obj(test::l_domain(1), true), 15, 9000);
  survive("text.ply", test::ply(test::l_domain(1), false), 10, 10000);
  survive("binary.ply", test::ply(test::l_domain(1), true), 10, 11000);
}

} // namespace
} // namespace tessera::preprocess
