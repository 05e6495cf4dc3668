// Every case of geometries/ from its file to its picture, through the program. New folders are found by
// themselves.

#include "tests/cli/program.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

const fs::path geometries = fs::path(TESSERA_SOURCE_DIR) / "geometries";

std::vector<fs::path> all_cases() {
  std::vector<fs::path> cases;
  for (const fs::directory_entry& folder : fs::directory_iterator(geometries))
    if (folder.is_directory())
      for (const fs::directory_entry& file : fs::directory_iterator(folder))
        if (file.path().extension() == ".toml" && !file.path().filename().string().starts_with("study"))
          cases.push_back(fs::relative(file.path(), geometries));
  std::sort(cases.begin(), cases.end());
  return cases;
}

/// "ecae/die.toml" is "ecae_die".
std::string test_name(const fs::path& path) {
  std::string name = (path.parent_path() / path.stem()).string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return name;
}

class Geometries : public testing::TestWithParam<fs::path> {};

TEST_P(Geometries, FromTheFileToThePicture) {
  const Workplace place;
  const fs::path file = geometries / GetParam();
  const std::vector<std::string> arguments{"prepare", file.string(), "-o", "out", "--quiet", "--json",
                                           // a few hundred: this wins over a spacing the case states
                                           "--set", "particles.count=500"};
  Workplace::Surroundings surroundings;
  surroundings.pictures = true;
  const Result result = place.tessera(arguments, surroundings);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "") << "pictures are drawn without a note";

  const nlohmann::json quality = nlohmann::json::parse(place.read("out/quality.json"));
  const double domain = quality.at("domain_volume"), cad = quality.at("cad_volume");
  EXPECT_GE(quality.at("particles"), 100);
  EXPECT_LT(quality.at("volume_error"), 1e-12);
  EXPECT_LT(quality.at("closure_error"), 1e-12);
  EXPECT_LT(std::abs(domain - cad), 1e-3 * cad) << "the default tolerance of the import";

  const std::string picture = place.read("out/cloud.png");
  EXPECT_EQ(picture.substr(0, 4), "\x89PNG");
  EXPECT_GT(picture.size(), 20'000U) << "a picture, not an empty page";
  EXPECT_GT(place.read("out/cloud_histograms.png").size(), 5'000U);
  const std::string report = place.read("out/report.md");
  for (const char* piece :
       {"![cloud](cloud.png)", "![cloud_histograms](cloud_histograms.png)", "Nominal spacing h"})
    EXPECT_NE(report.find(piece), std::string::npos) << piece;
  // Subvolumes that all are alike are not those of the particles' cells.
  if (report.find("| Subvolumes | uniform |") == std::string::npos) {
    EXPECT_LT(quality.at("first_moment_error"), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Geometries, testing::ValuesIn(all_cases()),
                         [](const auto& one) { return test_name(one.param); });

} // namespace
} // namespace tessera::cli
