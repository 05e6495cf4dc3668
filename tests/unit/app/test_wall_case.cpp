#include "solver/boundary/plane.hpp"
#include "tests/unit/app/case_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tessera::app {
namespace {

constexpr const char* its_plane = "plane = {point = [0, 0, 0], normal = [0, 0, 1]}";

/// The complete case with these lines as its wall, of a plane body or one in space.
std::string wall_case(const std::string& lines, bool plane = false) {
  std::string text = with(its_plane, lines);
  if (plane)
    text.insert(text.find("unit = "), "dimension = 2\n");
  return text;
}

std::string plane_case(const std::string& lines) {
  return wall_case(lines, true);
}

solver::SceneSpec scene(const std::string& text) {
  return read_text_case(text).scene;
}

double distance(const solver::WallSpec& wall, double x, double y, double z = 0) {
  return wall.shape->gap({x, y, z}).distance;
}

/// Each piece is in the one line of the message.
void expect_message(const std::string& text, const std::vector<std::string>& pieces) {
  const std::string line = message(text);
  for (const std::string& piece : pieces)
    EXPECT_NE(line.find(piece), std::string::npos) << "'" << piece << "' is not in: " << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

/// Where the line of the wall begins in a text of wall_case(), with the column.
std::string place(const std::string& text, const std::string& of, int column) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(of));
  return "case.toml:" + std::to_string(1 + std::count(text.begin(), end, '\n')) + ":" +
         std::to_string(column);
}

const std::string die =
    "channel = {path = [[0.004, 0.056], [0.004, -0.004], [0.028, -0.004], [0.028, -0.048]], "
    "width = 0.008, outer_fillet = 0.0015, inner_fillet = 0.001}";

TEST(CaseWalls, APlaneHasItsDefaults) {
  const auto walls = scene(wall_case(its_plane)).walls;
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].name, "wall_1");
  EXPECT_EQ(walls[0].friction, 0);
  EXPECT_EQ(walls[0].restitution, 0);
  EXPECT_EQ(walls[0].method, solver::ContactMethod::reflection);
  EXPECT_EQ(walls[0].velocity, Vec3::Zero());
  EXPECT_EQ(distance(walls[0], 1, 2, -3), -3);
}

TEST(CaseWalls, EveryStatedValueArrives) {
  const auto walls =
      scene(wall_case(std::string("name = \"punch\"\nfriction = 0.1\nrestitution = 0.2\n"
                                  "method = \"penalty\"\nstiffness = 0.5\nvelocity = [0, 0, 3]\n") +
                      its_plane))
          .walls;
  EXPECT_EQ(walls[0].name, "punch");
  EXPECT_EQ(walls[0].friction, 0.1);
  EXPECT_EQ(walls[0].restitution, 0.2);
  EXPECT_EQ(walls[0].method, solver::ContactMethod::penalty);
  EXPECT_EQ(walls[0].stiffness, 0.5);
  EXPECT_EQ(walls[0].velocity, Vec3(0, 0, 3));
}

TEST(CaseWalls, AChannelIsTwoWalls) {
  const auto walls = scene(plane_case("name = \"die\"\nfriction = 0.05\n" + die)).walls;
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_EQ(walls[0].name, "die_left");
  EXPECT_EQ(walls[1].name, "die_right");
  EXPECT_EQ(walls[0].friction, 0.05);
  EXPECT_NEAR(distance(walls[0], 0.002, 0.04), 0.006, 1e-15);
  EXPECT_NEAR(distance(walls[1], 0.002, 0.04), 0.002, 1e-15);
}

TEST(CaseWalls, APolylineMayBeRounded) {
  const auto walls =
      scene(plane_case("polyline = {points = [[-1, 0], [0, 0], [0, 1]], fillets = [0.5]}\n[[wall]]\n"
                       "polyline = {points = [[-1, 0], [0, 0], [0, 1]]}"))
          .walls;
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_EQ(walls[1].name, "wall_2");
  EXPECT_LT(distance(walls[0], -0.05, 0.05), 0);
  EXPECT_NEAR(distance(walls[1], -0.05, 0.05), 0.05, 1e-15);
}

TEST(CaseWalls, ASurfaceIsReadLater) {
  const Case c = read_text_case(wall_case("surface = {file = \"die.stl\", unit = \"mm\"}\n[[wall]]\n" +
                                          std::string(its_plane) +
                                          "\n[[wall]]\nsurface = {shape = \"sphere\", radius = 0.1}"));
  ASSERT_EQ(c.scene.walls.size(), 3U);
  EXPECT_EQ(c.scene.walls[0].shape, nullptr);
  ASSERT_EQ(c.wall_surfaces.size(), 2U);
  EXPECT_EQ(c.wall_surfaces[0].wall, 0U);
  EXPECT_EQ(c.wall_surfaces[0].source.unit, "mm");
  EXPECT_TRUE(c.wall_surfaces[0].source.file.is_absolute());
  EXPECT_EQ(c.wall_surfaces[1].wall, 2U);
  EXPECT_EQ(c.wall_surfaces[1].entry, 2U);
  // The stored case finds the file from wherever it is.
  EXPECT_NE(c.text.find(c.wall_surfaces[0].source.file.string()), std::string::npos);
}

TEST(CaseWallErrors, ExactlyOneShape) {
  const std::string text = wall_case("friction = 0.1");
  expect_message(text, {"a [[wall]] entry has no shape", place(text, "[[wall]]", 1),
                        "exactly one of plane, channel, polyline and surface"});
  expect_message(plane_case("polyline = {points = [[0, 0], [1, 0]]}\n" + die),
                 {"a [[wall]] entry has channel and polyline"});
}

TEST(CaseWallErrors, UnknownKeysNameTheNearest) {
  expect_message(
      wall_case("plain = {point = [0, 0, 0], normal = [0, 0, 1]}"),
      {"unknown key 'wall.0.plain'", "did you mean 'plane'?", "keys in wall.0: ", "channel", "surface"});
  expect_message(plane_case("channel = {path = [[0, 0], [1, 0]], width = 1, fillet = 1}"),
                 {"unknown key 'wall.0.channel.fillet'", "outer_fillet"});
  expect_message(plane_case("channel = {path = [[0, 0], [1, 0]]}"), {"missing key 'wall.0.channel.width'"});
  expect_message(wall_case(std::string(its_plane) + "\nmethod = \"penality\""),
                 {"wall.0.method is 'penality'", "did you mean 'penalty'?", "known: reflection, penalty"});
  expect_message(wall_case("surface = {file = \"die.stl\", unit = \"mn\"}"), {"wall.0.surface.unit", "mm"});
  expect_message(wall_case("surface = {file = \"die.stl\"}"), {"missing key 'wall.0.surface.unit'"});
}

TEST(CaseWallErrors, ValuesAreInRange) {
  expect_message(wall_case(std::string(its_plane) + "\nfriction = -0.1"),
                 {"wall.0.friction is -0.1", "0 or more"});
  expect_message(wall_case(std::string(its_plane) + "\nrestitution = 2"),
                 {"wall.0.restitution is 2", "between 0 and 1"});
  expect_message(wall_case(std::string(its_plane) + "\nmethod = \"penalty\"\nstiffness = 0"),
                 {"wall.0.stiffness is 0", "greater than 0 and at most 10"});
  expect_message(wall_case(std::string(its_plane) + "\nstiffness = 1"),
                 {"wall.0.stiffness does nothing to a wall that reflects", "penalty"});
  expect_message(wall_case(std::string(its_plane) + "\nname = \"a b\""), {"wall.0.name is 'a b'"});
  expect_message(wall_case(std::string("name = \"wall_2\"\n") + its_plane + "\n[[wall]]\n" + its_plane),
                 {"two walls are called 'wall_2'"});
  expect_message(wall_case("plane = {point = [0, 0, 0], normal = [0, 0, 0]}"), {"the wall's normal is zero"});
}

TEST(CaseWallErrors, ShapesFitTheDimension) {
  expect_message(wall_case(die), {"a channel meets plane bodies only", "geometry.dimension = 2"});
  expect_message(wall_case("polyline = {points = [[0, 0], [1, 0]]}"), {"a polyline meets plane bodies only"});
  expect_message(plane_case("surface = {file = \"die.stl\", unit = \"mm\"}"),
                 {"a surface meets bodies in space only"});
  expect_message(plane_case(its_plane), {"the wall's normal leaves the plane of the body"});
  expect_message(plane_case("velocity = [0, 0, 1]\n" + die),
                 {"the wall's velocity leaves the plane of the body"});
  expect_message(wall_case("surface = {shape = \"disc\", radius = 1, dimension = 2}"),
                 {"wall.0.surface.dimension is 2"});
}

TEST(CaseWallErrors, LinesThatDoNotFitSayWhatAndWhere) {
  const std::string tight =
      plane_case("channel = {path = [[0, 0], [1, 0], [1, 1]], width = 0.2, outer_fillet = 1.2}");
  expect_message(tight, {"the fillet of 1.2 m at (1.1, -0.1) does not fit", place(tight, "channel = ", 11),
                         "take smaller fillets or longer pieces"});
  expect_message(plane_case("channel = {path = [[0, 0], [4, 0], [4, 1], [0, 1]], width = 1.1}"),
                 {"does not fit the path's piece of 1 m to (4, 1)", "make it narrower"});
  expect_message(plane_case("channel = {path = [[0, 0]], width = 1}"),
                 {"wall.0.channel.path is a list", "two or more points"});
  expect_message(plane_case("channel = {path = [[0, 0], [1, 0, 0]], width = 1}"),
                 {"wall.0.channel.path.1 is a list", "two numbers [x, y]"});
  expect_message(plane_case("channel = {path = [[0, 0], [1, 0], [1, 0]], width = 1}"),
                 {"point 3 of a wall's line, (1, 0), repeats the one before"});
  expect_message(plane_case("polyline = {points = [[0, 0], [1, 0], [1, 1]], fillets = [0.1, 0.1]}"),
                 {"3 points lists 2 fillets", "each of its 1 inner points"});
  expect_message(plane_case("polyline = {points = [[0, 0], [\"a\", 0]]}"),
                 {"wall.0.polyline.points.1.0 is text in quotes", "a number"});
}

} // namespace
} // namespace tessera::app
