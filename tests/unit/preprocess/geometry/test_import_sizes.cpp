#include "preprocess/geometry/domain_stream.hpp"
#include "tests/support/domains.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"
#include "tests/unit/preprocess/geometry/mesh_files.hpp"

namespace tessera::preprocess {
namespace {

class ImportSizes : public ImportFixture {
 protected:
  static GeometrySource following(const std::filesystem::path& file, int dimension = 3) {
    GeometrySource source{.file = file, .unit = "m"};
    source.dimension = dimension;
    source.background_sizes = true;
    return source;
  }
};

/// Mean edge of the tetrahedra with their centre between two x (in the plane: of their edges that lie flat).
double mean_edge(const Domain& domain, double low, double high) {
  double sum = 0;
  int count = 0;
  for (const auto& tet : domain.tets) {
    double x = 0;
    for (const auto v : tet)
      x += domain.vertices[v][0] / 4;
    if (x < low || x > high)
      continue;
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) {
        const Vec3 d = domain.vertices[tet[a]] - domain.vertices[tet[b]];
        if (domain.dimension == 2 && d[2] != 0)
          continue;
        sum += d.norm();
        ++count;
      }
  }
  return sum / count;
}

const std::string field = "Field[1] = MathEval; Field[1].F = \"0.1 + 0.1*x\"; Background Field = 1;\n"
                          "Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;\n";

TEST_F(ImportSizes, the_mesh_follows_a_background_field_inside_too) {
  const auto file = occ("bar.geo", "Box(1) = {0,0,0, 4,1,1};\n" + field);
  const Domain graded = import(following(file));
  EXPECT_NEAR(graded.volume, 4, 1e-12);
  EXPECT_NEAR(mean_edge(graded, 3.5, 4) / mean_edge(graded, 0, 0.5), 0.475 / 0.125, 0.8);
  EXPECT_NEAR(mean_edge(graded, 0, 0.5), 0.125, 0.05);
  EXPECT_TRUE(to_bytes(import(following(file))) == to_bytes(graded));
  EXPECT_LT(import(file, "m").tets.size(), graded.tets.size() / 2); // not asked for, not followed
}

TEST_F(ImportSizes, so_does_the_mesh_of_a_plane_body) {
  const auto file = occ("strip.geo", "Rectangle(1) = {0,0,0, 4,1};\n" + field);
  const Domain graded = import(following(file, 2));
  EXPECT_NEAR(graded.volume, 4, 1e-12);
  EXPECT_NEAR(mean_edge(graded, 3.5, 4) / mean_edge(graded, 0, 0.5), 0.475 / 0.125, 0.8);
  EXPECT_LT(import_plane(file).tets.size(), graded.tets.size() / 2);
}

TEST_F(ImportSizes, sizes_at_points_count_as_well) {
  const Domain graded = import(following(write("points.geo", R"(
    Point(1) = {0,0,0, 0.05}; Point(2) = {4,0,0, 0.4}; Point(3) = {4,1,0, 0.4}; Point(4) = {0,1,0, 0.05};
    Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
    Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};)"),
                                         2));
  EXPECT_NEAR(graded.volume, 4, 1e-12);
  EXPECT_GT(mean_edge(graded, 3.5, 4) / mean_edge(graded, 0, 0.5), 3);
}

TEST_F(ImportSizes, proportions_stay_where_curved_faces_ask_for_more) {
  const auto file =
      occ("ring.geo", "Disk(1) = {0,0,0, 1};\nField[1] = MathEval; Field[1].F = \"0.3 + 0.2*x\";\n"
                      "Background Field = 1; Mesh.MeshSizeExtendFromBoundary = 0;\n");
  const Domain graded = import(following(file, 2));
  EXPECT_LT(std::abs(graded.volume / graded.cad_volume - 1), 1e-3);
  EXPECT_NEAR(mean_edge(graded, 0.7, 1) / mean_edge(graded, -1, -0.7), 0.46 / 0.14, 0.8);
}

TEST_F(ImportSizes, files_without_sizes_are_refused_and_a_mesh_is_its_own_field) {
  EXPECT_SAYS(
      complaint(following(std::string(TESSERA_SOURCE_DIR) + "/geometries/taylor_bar/taylor_bar.step")),
      "no mesh sizes");
  GeometrySource box = shape("box", {{1, 1, 1}});
  box.background_sizes = true;
  EXPECT_SAYS(complaint(box), "no mesh sizes");
  const Domain part = test::l_domain(2);
  EXPECT_EQ(import(following(write("part.msh", test::msh2(part, true)))).tets.size(), part.tets.size());
}

TEST_F(ImportSizes, sizes_that_take_forever_end_at_the_limit) {
  GeometrySource source = following(occ("dust.geo", "Box(1) = {0,0,0, 1,1,1};\nField[1] = MathEval;\n"
                                                    "Field[1].F = \"1e-4\"; Background Field = 1;\n"));
  source.seconds = 2;
  EXPECT_SAYS(complaint(source), "enlarge mesh sizes");
}

} // namespace
} // namespace tessera::preprocess
