#include "preprocess/geometry/domain_stream.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"

#include <fmt/format.h>

#include <numbers>

namespace tessera::preprocess {
namespace {

using std::numbers::pi;

class ImportShapes : public ImportFixture {};

struct Expected {
  std::string name;
  int dimension;
  std::vector<std::vector<double>> lengths;
  double volume;
  std::map<std::string, double> areas; ///< of each set
  std::size_t corners, curves;
};

const std::vector<Expected>& expected() {
  static const std::vector<Expected> shapes{
      {"box",
       3,
       {{1, 2, 3}},
       6,
       {{"x_min", 6}, {"x_max", 6}, {"y_min", 3}, {"y_max", 3}, {"z_min", 2}, {"z_max", 2}},
       8,
       12},
      {"cylinder", 3, {{0.5}, {2}}, pi / 2, {{"bottom", pi / 4}, {"top", pi / 4}, {"side", 2 * pi}}, 0, 2},
      {"sphere", 3, {{1.5}}, 4.5 * pi, {{"side", 9 * pi}}, 0, 0},
      {"tube",
       3,
       {{1}, {0.75}, {2}},
       2 * pi * (1 - 0.5625),
       {{"bottom", pi * 0.4375}, {"top", pi * 0.4375}, {"side", 4 * pi}, {"bore", 3 * pi}},
       0,
       4},
      {"plate_with_hole",
       3,
       {{4, 3, 0.5}, {1}},
       (12 - pi) / 2,
       {{"x_min", 1.5},
        {"x_max", 1.5},
        {"y_min", 2},
        {"y_max", 2},
        {"z_min", 12 - pi},
        {"z_max", 12 - pi},
        {"hole", pi}},
       8,
       14},
      {"l_part",
       3,
       {{2, 3, 4}, {1}}, // the foot's middle is as far out as the inner face
       16,
       {{"x_min", 12},
        {"x_max", 4},
        {"y_min", 8},
        {"y_max", 4},
        {"z_min", 4},
        {"z_max", 4},
        {"inner_x", 8},
        {"inner_y", 4}},
       12,
       18},
      {"t_part",
       3,
       {{3, 4, 2}, {1}},
       12,
       {{"x_min", 2},
        {"x_max", 2},
        {"y_min", 2},
        {"y_max", 6},
        {"z_min", 6},
        {"z_max", 6},
        {"web_left", 6},
        {"web_right", 6},
        {"flange_under", 4}},
       16,
       24},
      {"rectangle", 2, {{2, 1}}, 2, {{"left", 1}, {"right", 1}, {"bottom", 2}, {"top", 2}}, 4, 4},
      {"disc", 2, {{2}}, 4 * pi, {{"side", 4 * pi}}, 0, 1},
      {"ring", 2, {{2}, {1}}, 3 * pi, {{"side", 4 * pi}, {"bore", 2 * pi}}, 0, 2},
      {"plate_with_hole",
       2,
       {{4, 3}, {1}},
       12 - pi,
       {{"left", 3}, {"right", 3}, {"bottom", 4}, {"top", 4}, {"hole", 2 * pi}},
       4,
       5},
      {"l_part",
       2,
       {{2, 3}, {1}},
       4,
       {{"left", 3}, {"right", 1}, {"bottom", 2}, {"top", 1}, {"inner_x", 2}, {"inner_y", 1}},
       6,
       6},
      {"t_part",
       2,
       {{3, 4}, {1}},
       6,
       {{"left", 1},
        {"right", 1},
        {"bottom", 1},
        {"top", 3},
        {"web_left", 3},
        {"web_right", 3},
        {"flange_under", 2}},
       8,
       8},
  };
  return shapes;
}

TEST_F(ImportShapes, have_their_volume_names_and_corners) {
  ASSERT_EQ(expected().size(), known_shapes().size());
  for (std::size_t k = 0; k < expected().size(); ++k) {
    const Expected& e = expected()[k];
    const ShapeKind& kind = known_shapes()[k];
    const std::string what = fmt::format("{} of dimension {}", e.name, e.dimension);
    SCOPED_TRACE(what);
    EXPECT_EQ(kind.name, e.name);
    EXPECT_EQ(kind.dimension, e.dimension);
    GeometrySource source = shape(e.name, e.lengths, e.dimension);
    source.tolerance = 3e-3;
    const Domain domain = import(source);
    EXPECT_EQ(domain.dimension, e.dimension);
    EXPECT_NEAR(domain.cad_volume / e.volume, 1, 1e-9);
    EXPECT_LT(std::abs(domain.volume / domain.cad_volume - 1), source.tolerance);
    EXPECT_EQ(domain.corners.size(), e.corners);
    EXPECT_EQ(curves(domain), e.curves);
    std::vector<std::string> names;
    for (const auto& group : domain.groups) {
      names.push_back(group.name);
      EXPECT_EQ(group.dimension, 2);
    }
    EXPECT_EQ(names, kind.surfaces);
    const auto area = areas(domain);
    for (const auto& [name, exact] : e.areas)
      EXPECT_NEAR(area.at(name) / exact, 1, 5e-3) << name;
    EXPECT_EQ(area.size(), e.areas.size());
  }
}

TEST_F(ImportShapes, lie_where_the_header_says) {
  const auto coarse = [](GeometrySource source) {
    source.tolerance = 1e-2;
    return import(source);
  };
  const Domain bar = coarse(shape("cylinder", {{1}, {4}}));
  EXPECT_NEAR((bar.lower - Vec3(-1, -1, 0)).norm(), 0, 2e-2);
  EXPECT_NEAR((bar.upper - Vec3(1, 1, 4)).norm(), 0, 2e-2);
  const Domain ball = coarse(shape("sphere", {{1}}));
  EXPECT_NEAR((ball.lower + ball.upper).norm(), 0, 2e-2);
  const Domain box = import(shape("box", {{1, 2, 3}}));
  EXPECT_NEAR(box.lower.norm(), 0, 1e-15);
  EXPECT_NEAR((box.upper - Vec3(1, 2, 3)).norm(), 0, 1e-15);
  const Domain part = import(shape("l_part", {{2, 3}, {0.5}}, 2));
  EXPECT_NEAR(part.lower.norm(), 0, 1e-15);
  EXPECT_NEAR((part.upper - Vec3(2, 3, 0)).norm(), 0, 1e-15);
}

TEST_F(ImportShapes, are_the_same_at_any_size) {
  const Domain one = import(shape("plate_with_hole", {{4, 3, 1}, {1}}));
  for (const int power : {-20, 10}) {
    const double s = std::exp2(power);
    const Domain other = import(shape("plate_with_hole", {{4 * s, 3 * s, s}, {s}}));
    ASSERT_EQ(other.vertices.size(), one.vertices.size());
    for (std::size_t v = 0; v < one.vertices.size(); ++v)
      ASSERT_EQ(other.vertices[v] / s, one.vertices[v]);
  }
}

TEST_F(ImportShapes, lengths_that_make_no_sense_are_refused) {
  const auto says = [](const GeometrySource& source) { return complaint(source); };
  EXPECT_SAYS(says(shape("ball", {{1}})), "give one of box, cylinder, sphere");
  EXPECT_SAYS(says(shape("box", {{1, 1}}, 2)), "give one of rectangle, disc");
  EXPECT_SAYS(says(shape("box", {{1, 2}})), "size has 2 numbers, not 3");
  EXPECT_SAYS(says(shape("cylinder", {{1}})), "takes 2 lengths, not 1");
  EXPECT_SAYS(says(shape("cylinder", {{-1}, {1}})), "radius is -1");
  EXPECT_SAYS(says(shape("cylinder", {{0}, {1}})), "[geometry] radius");
  EXPECT_SAYS(says(shape("sphere", {{std::nan("")}})), "radius is nan");
  EXPECT_SAYS(says(shape("disc", {{INFINITY}}, 2)), "radius is inf");
  EXPECT_SAYS(says(shape("tube", {{1}, {1}, {2}})), "inner radius 1 m is not smaller");
  EXPECT_SAYS(says(shape("ring", {{1}, {2}}, 2)), "[geometry] inner_radius");
  EXPECT_SAYS(says(shape("plate_with_hole", {{4, 3, 1}, {1.5}})), "give less than 1.5");
  EXPECT_SAYS(says(shape("plate_with_hole", {{4, 3}, {2}}, 2)), "does not fit");
  EXPECT_SAYS(says(shape("l_part", {{2, 3, 1}, {2}})), "thickness of 2 m");
  EXPECT_SAYS(says(shape("t_part", {{2, 3}, {2.5}}, 2)), "[geometry] thickness");
  EXPECT_SAYS(says(shape("box", {{1, 1, 1e-6}})), "too far apart");
}

TEST_F(ImportShapes, same_shape_same_bits) {
  auto source = shape("tube", {{1}, {0.5}, {1}});
  source.tolerance = 1e-2;
  EXPECT_TRUE(to_bytes(import(source)) == to_bytes(import(source)));
}

} // namespace
} // namespace tessera::preprocess
