#include "preprocess/geometry/domain_stream.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"

#include <fmt/format.h>

#include <numbers>

namespace tessera::preprocess {
namespace {

using std::numbers::pi;

class ImportPlane : public ImportFixture {};

std::set<std::pair<double, double>> corners_of(const Domain& domain) {
  std::set<std::pair<double, double>> found;
  for (const auto v : domain.corners) {
    EXPECT_EQ(domain.vertices[v][2], 0.5);
    found.emplace(domain.vertices[v][0], domain.vertices[v][1]);
  }
  return found;
}

TEST_F(ImportPlane, straight_edged_figure_is_exact_in_any_plane_and_unit) {
  for (const double z : {0.0, 7.5, -3.0}) {
    const auto file = occ("plate.geo", fmt::format("Rectangle(1) = {{1, 2, {}, 3, 4}};", z));
    const Domain domain = import_plane(file, "mm");
    EXPECT_EQ(domain.dimension, 2);
    EXPECT_NEAR(domain.volume / 12e-6, 1, 1e-13);
    EXPECT_NEAR(domain.cad_volume / 12e-6, 1, 1e-9);
    EXPECT_NEAR((domain.lower - Vec3(1e-3, 2e-3, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR((domain.upper - Vec3(4e-3, 6e-3, 0)).norm(), 0, 1e-15);
    EXPECT_EQ(corners_of(domain).size(), 4u);
    EXPECT_EQ(curves(domain), 4u);
    const auto length = areas(domain);
    EXPECT_NEAR(length.at("edge1"), 3e-3, 1e-15);
    EXPECT_NEAR(length.at("edge2"), 4e-3, 1e-15);
    EXPECT_EQ(length.size(), 4u);
  }
}

TEST_F(ImportPlane, curved_edges_are_refined_to_the_tolerance) {
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const Domain disc = import_plane(occ("disc.geo", "Disk(1) = {0, 0, 0, 2};"), "m", tolerance);
    EXPECT_NEAR(disc.cad_volume, 4 * pi, 1e-8);
    EXPECT_LT(std::abs(disc.volume / disc.cad_volume - 1), tolerance);
    EXPECT_LT(disc.volume, disc.cad_volume);
    EXPECT_TRUE(disc.corners.empty()); // the vertex that begins and ends the rim is none
    EXPECT_EQ(curves(disc), 1u);
  }
}

TEST_F(ImportPlane, gmsh_own_kernel_is_refined_without_a_reference) {
  const Domain domain = import_plane(write("own.geo", R"(
    Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {0,1,0}; Point(4) = {-1,0,0}; Point(5) = {0,-1,0};
    Circle(1) = {2,1,3}; Circle(2) = {3,1,4}; Circle(3) = {4,1,5}; Circle(4) = {5,1,2};
    Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {-1};)"));
  EXPECT_NEAR(domain.volume / pi, 1, 1e-3);
  EXPECT_NEAR(domain.cad_volume / pi, 1, 1e-4);
  EXPECT_EQ(domain.corners.size(), 4u); // where its four curves meet
}

TEST_F(ImportPlane, holes_and_physical_groups_are_kept) {
  const Domain domain = import_plane(occ("holed.geo", R"(
    Rectangle(1) = {0,0,0, 4,2}; Disk(2) = {1,1,0, 0.5};
    BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }
    p() = Point In BoundingBox{-0.1,-0.1,-0.1, 0.1,0.1,0.1};
    l() = Curve In BoundingBox{-0.1,-0.1,-0.1, 0.1,2.1,0.1};
    h() = Curve In BoundingBox{0.4,0.4,-0.1, 1.6,1.6,0.1};
    Physical Point("foot") = {p()}; Physical Curve("clamp") = {l()}; Physical Curve("hole") = {h()};
    Physical Surface("steel") = {1};)"),
                                     "m", 1e-4);
  EXPECT_NEAR(domain.cad_volume, 8 - pi / 4, 1e-8);
  EXPECT_NEAR(domain.volume / domain.cad_volume, 1, 1e-4);
  ASSERT_EQ(domain.groups.size(), 4u);
  const auto length = areas(domain);
  EXPECT_NEAR(length.at("clamp"), 2, 1e-12);
  EXPECT_NEAR(length.at("hole"), pi, 1e-2);
  EXPECT_EQ(group_named(domain, "clamp").dimension, 2);
  EXPECT_EQ(group_named(domain, "steel").dimension, 3);
  const auto& foot = group_named(domain, "foot");
  EXPECT_EQ(foot.dimension, 0);
  ASSERT_EQ(foot.vertices.size(), 1u);
  EXPECT_NEAR((domain.vertices[foot.vertices[0]] - Vec3(0, 0, 0.5)).norm(), 0, 1e-15);
  EXPECT_EQ(domain.corners.size(), 4u);
}

TEST_F(ImportPlane, surfaces_that_touch_are_one_body) {
  // They share only a part of their edges, so they must be cut to fit.
  const Domain domain = import_plane(occ("steps.geo", R"(
    Rectangle(1) = {0,0,0, 2,1}; Rectangle(2) = {0.5,1,0, 1,1};
    Physical Curve("top") = {7}; Physical Surface("both") = {1, 2};)"));
  EXPECT_NEAR(domain.volume, 3, 1e-12);
  EXPECT_EQ(domain.corners.size(), 8u);
  double around = 0;
  std::map<std::int32_t, double> length;
  for (const auto& edge : domain.feature_edges)
    around += (domain.vertices[edge.vertices[0]] - domain.vertices[edge.vertices[1]]).norm();
  EXPECT_NEAR(around, 2 + 1 + 0.5 + 1 + 1 + 1 + 0.5 + 1, 1e-12);
  EXPECT_NEAR(areas(domain).at("top"), 1, 1e-12);

  const Domain own = import_plane(write("own.geo", R"(
    Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {2,0,0};
    Point(6) = {2,1,0}; Point(7) = {1,0,0}; Point(8) = {1,1,0};
    Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
    Line(5) = {7,5}; Line(6) = {5,6}; Line(7) = {6,8}; Line(8) = {8,7};
    Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1}; Curve Loop(2) = {5,6,7,8}; Plane Surface(2) = {2};)"));
  EXPECT_NEAR(own.volume, 2, 1e-12);
}

TEST_F(ImportPlane, separate_surfaces_are_counted_and_chosen) {
  const auto file = occ("two.geo", "Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {3,0,0, 2,1};\n"
                                   "Physical Curve(\"left\") = {4}; Physical Curve(\"right\") = {6};");
  const std::string said = complaint(file, 2);
  EXPECT_SAYS(said, "2 separate plane figures");
  EXPECT_SAYS(said, "of area 2 from (3, ");
  EXPECT_SAYS(said, "solid = N");
  for (const int solid : {1, 2}) {
    GeometrySource source{.file = file, .unit = "m"};
    source.dimension = 2;
    source.solid = solid;
    const Domain domain = import(source);
    EXPECT_NEAR(domain.volume, solid, 1e-12);
    ASSERT_EQ(domain.groups.size(), 1u);
    EXPECT_EQ(domain.groups[0].name, solid == 1 ? "left" : "right");
    EXPECT_EQ(domain.groups[0].surfaces.size(), 1u);
  }
  GeometrySource third{.file = file, .unit = "m"};
  third.dimension = 2;
  third.solid = 3;
  EXPECT_SAYS(complaint(third), "solid is 3, but there are 2");
}

TEST_F(ImportPlane, what_is_not_plane_is_said) {
  EXPECT_SAYS(complaint(occ("ball.geo", "Sphere(1) = {0,0,0, 1};"), 2), "holds 1 solid, not a plane figure");
  EXPECT_SAYS(
      complaint(occ("wall.geo", "Rectangle(1) = {0,0,0, 1,2}; Rotate{{1,0,0},{0,0,0},Pi/2}{ Surface{1}; }"),
                2),
      "it reaches from z = 0 to 2");
  EXPECT_SAYS(complaint(occ("floors.geo", "Rectangle(1) = {0,0,0, 1,2}; Rectangle(2) = {0,0,1, 1,2};"), 2),
              "2 separate plane figures");
  EXPECT_SAYS(complaint(occ("stairs.geo", "Rectangle(1) = {0,0,0, 1,1}; Line(9) = {2,3};\n"
                                          "Extrude {0,0,1} { Curve{2}; }"),
                        2),
              "does not lie in a plane z = const");
  EXPECT_SAYS(complaint(occ("wire.geo", "Point(1) = {0,0,0}; Point(2) = {1,0,0}; Line(1) = {1,2};"), 2),
              "only 1 curves");
  EXPECT_SAYS(complaint(occ("flat.geo", "Rectangle(1) = {0,0,0,1,1};"), 3), "dimension = 2");
}

TEST_F(ImportPlane, step_brep_and_their_bits) {
  // gmsh's own .brep of a rectangle with a round hole is among the formats that it can write itself.
  const auto file = occ("disc.geo", "Disk(1) = {0, 0, 0, 2, 1};");
  EXPECT_TRUE(to_bytes(import_plane(file)) == to_bytes(import_plane(file)));
}

// ---- meshes

/// Two squares of two triangles each, `lines` for the lines of the boundary.
std::string squares(const std::string& lines, double apart = 0) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 7 \"west\"\n2 9 \"all\"\n"
                     "$EndPhysicalNames\n$Nodes\n8\n";
  int n = 0;
  for (const double x : {0.0, 1.0, 1.0 + apart, 2.0 + apart})
    for (const double y : {0.0, 1.0})
      text += fmt::format("{} {} {} 4\n", ++n, x, y);
  const int second = apart > 0 ? 5 : 3;
  text += "$EndNodes\n$Elements\n";
  const std::string triangles = fmt::format("11 2 2 9 1 1 3 4\n12 2 2 9 1 1 2 4\n13 2 2 9 1 {0} 7 8\n"
                                            "14 2 2 9 1 {0} {1} 8\n",
                                            second, second + 1);
  const auto count = 4 + std::count(lines.begin(), lines.end(), '\n');
  return text + fmt::format("{}\n", count) + lines + triangles + "$EndElements\n";
}

TEST_F(ImportPlane, msh_with_lines_keeps_its_curves_and_without_is_cut_at_kinks) {
  const Domain bare = import_plane(write("bare.msh", squares("")));
  EXPECT_NEAR(bare.volume, 2, 1e-15);
  EXPECT_EQ(bare.surfaces.size(), 4u);
  EXPECT_EQ(bare.corners.size(), 4u);
  const Domain lines = import_plane(write(
      "lines.msh",
      squares("1 1 2 7 1 1 2\n2 1 2 0 2 1 3\n3 1 2 0 2 3 7\n4 1 2 0 3 7 8\n5 1 2 0 4 8 4\n6 1 2 0 5 4 2\n")));
  EXPECT_EQ(lines.surfaces.size(), 5u);
  EXPECT_EQ(lines.corners.size(), 5u); // one of them where two curves meet on a straight line
  EXPECT_NEAR(areas(lines).at("west"), 1, 1e-15);
  EXPECT_EQ(group_named(lines, "all").dimension, 3);
  EXPECT_SAYS(complaint(write("some.msh", squares("1 1 2 7 1 1 2\n")), 2), "some sides");
}

TEST_F(ImportPlane, msh_pieces_are_counted_and_chosen) {
  const auto file = write("two.msh", squares("", 1));
  EXPECT_SAYS(complaint(file, 2), "2 separate plane figures");
  GeometrySource source{.file = file, .unit = "m"};
  source.dimension = 2;
  source.solid = 2;
  const Domain domain = import(source);
  EXPECT_NEAR(domain.volume, 1, 1e-15);
  EXPECT_NEAR(domain.lower[0], 2, 1e-15);
  source.dimension = 3;
  EXPECT_SAYS(complaint(source), "no tetrahedra");
}

} // namespace
} // namespace tessera::preprocess
