// CAD and mesh files that cannot be used, and particles that do not fit.

#include "tests/cli/small_case.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace tessera::cli {
namespace {

std::string taylor_bar_step() {
  std::ifstream in(std::string(TESSERA_SOURCE_DIR) + "/geometries/taylor_bar/taylor_bar.step",
                   std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Checks the small case with another geometry file.
Result check_with(const Workplace& place, const std::string& file, const std::string& content) {
  write_small_case(place);
  place.write(file, content);
  return place.tessera({"check", "case.toml", "--quiet", "--set", "geometry.file=" + file});
}

TEST(Geometry, TruncatedStep) {
  const std::string step = taylor_bar_step();
  ASSERT_GT(step.size(), 1000U);
  const Workplace place;
  expect_error(check_with(place, "cut.step", step.substr(0, step.size() / 2)), {"cut.step"});
}

TEST(Geometry, StepWithAnEmptyShell) {
  std::string step = taylor_bar_step();
  const std::size_t shell = step.find("CLOSED_SHELL(");
  ASSERT_NE(shell, std::string::npos);
  const std::size_t open = step.find('(', shell + 13), close = step.find(')', open);
  step.erase(open + 1, close - open - 1);
  const Workplace place;
  expect_error(check_with(place, "hollow.step", step), {"hollow.step"});
}

TEST(Geometry, OpenStl) {
  // A tetrahedron without its fourth face.
  const Workplace place;
  const std::string facet = "facet normal 0 0 0\nouter loop\n";
  const std::string stl = "solid open\n" + facet +
                          "vertex 0 0 0\nvertex 0 10 0\nvertex 10 0 0\nendloop\nendfacet\n" + facet +
                          "vertex 0 0 0\nvertex 10 0 0\nvertex 0 0 10\nendloop\nendfacet\n" + facet +
                          "vertex 0 0 0\nvertex 0 0 10\nvertex 0 10 0\nendloop\nendfacet\nendsolid open\n";
  expect_error(check_with(place, "open.stl", stl), {"open.stl"});
}

TEST(Geometry, NotAGeometryAtAll) {
  const Workplace place;
  expect_error(check_with(place, "words.step", "these are words\n"), {"words.step"});
  expect_error(check_with(place, "empty.step", ""), {"empty.step"});
  expect_error(check_with(place, "box.xyz", "1 2 3\n"), {"box.xyz"});
}

TEST(Geometry, ScriptsMayNotRunPrograms) {
  const Workplace place;
  expect_error(check_with(place, "evil.geo",
                          "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\n"
                          "SystemCall \"touch pwned\";\n"),
               {"evil.geo", "trust"});
  EXPECT_FALSE(std::filesystem::exists(place / "pwned"));
}

TEST(Particles, SpacingFarTooLarge) {
  const Workplace place;
  write_small_case(place);
  expect_error(place.tessera({"run", "case.toml", "--quiet", "-o", "out", "--set", "particles.spacing=10"}),
               {"spacing"});
}

TEST(Particles, SupportTooSmallNamesAParticleAndItsNeighbours) {
  const Workplace place;
  write_small_case(place);
  // Just above 1: on a lattice the straight neighbours alone, too few at the corners to be a gradient.
  place.write("case.toml", with("jst4", "support = 1.0000001\njst4"));
  expect_error(place.tessera({"run", "case.toml", "--quiet", "-o", "out", "--set", "solver.neighbours=8",
                              "--set", "geometry.file=box.geo", "--set", "particles.arrangement=voronoi",
                              "--set", "particles.count=200"}),
               {"particle ", "neighbours", "support"});
}

} // namespace
} // namespace tessera::cli
