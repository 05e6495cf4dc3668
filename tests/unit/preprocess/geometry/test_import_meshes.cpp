#include "preprocess/geometry/domain_stream.hpp"
#include "tests/support/domains.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"
#include "tests/unit/preprocess/geometry/mesh_files.hpp"

#include <fmt/format.h>

namespace tessera::preprocess {
namespace {

namespace fs = std::filesystem;
using test::msh2;

class ImportMeshes : public ImportFixture {};

TEST_F(ImportMeshes, msh_with_groups_keeps_every_vertex_and_name) {
  const Domain part = test::l_domain(2);
  const Domain domain = import(write("part.msh", msh2(part, true)), "m");
  EXPECT_NEAR(domain.volume, 3, 1e-14);
  EXPECT_EQ(domain.tets.size(), part.tets.size());
  EXPECT_EQ(domain.vertices.size(), part.vertices.size());
  EXPECT_EQ(domain.corners.size(), 12u);
  EXPECT_EQ(curves(domain), 18u);
  std::set<std::string> names, wanted(part.surfaces.begin(), part.surfaces.end());
  for (const auto& group : domain.groups)
    if (group.dimension == 2) {
      names.insert(group.name);
      ASSERT_EQ(group.surfaces.size(), 1u);
      double area = 0;
      for (const auto& f : domain.facets)
        if (f.surface == group.surfaces[0]) {
          const Vec3& A = domain.vertices[f.vertices[0]];
          area += (domain.vertices[f.vertices[1]] - A).cross(domain.vertices[f.vertices[2]] - A).norm() / 2;
        }
      EXPECT_NEAR(area,
                  group.name.starts_with("z")   ? 3
                  : group.name.ends_with("min") ? 2
                                                : 1,
                  1e-12)
          << group.name;
    }
  EXPECT_EQ(names, wanted);
}

TEST_F(ImportMeshes, msh_without_triangles_is_cut_along_sharp_edges) {
  const Domain domain = import(write("bare.msh", msh2(test::l_domain(2), false)), "m");
  EXPECT_NEAR(domain.volume, 3, 1e-14);
  EXPECT_EQ(domain.surfaces.size(), 8u);
  EXPECT_EQ(domain.corners.size(), 12u);
  EXPECT_EQ(curves(domain), 18u);
}

TEST_F(ImportMeshes, msh_with_turned_tetrahedra_is_turned_back) {
  Domain part = test::box_domain(Vec3::Zero(), Vec3::Ones(), 2);
  for (std::size_t t = 0; t < part.tets.size(); t += 3)
    std::swap(part.tets[t][0], part.tets[t][1]);
  EXPECT_NEAR(import(write("turned.msh", msh2(part, false)), "m").volume, 1, 1e-14);
}

TEST_F(ImportMeshes, msh_of_version_4_1_is_read) {
  const Domain domain = import(write("one.msh", R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
2 7 "floor"
$EndPhysicalNames
$Entities
0 0 1 1
1 0 0 0 1 1 0 1 7 0
1 0 0 0 1 1 1 0 1 1
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
1 1 1 1
3 1 4 1
1 1 2 3 4
$EndElements
)"),
                               "cm");
  EXPECT_NEAR(domain.volume, 1e-6 / 6, 1e-20);
  EXPECT_EQ(domain.surfaces.size(), 4u);
  EXPECT_EQ(domain.corners.size(), 4u);
}

TEST_F(ImportMeshes, msh_bodies_are_counted_and_chosen) {
  const Domain part = test::box_domain();
  Domain two = part;
  for (const Vec3& X : part.vertices)
    two.vertices.push_back(X + Vec3(3, 0, 0));
  const auto n = static_cast<std::int32_t>(part.vertices.size());
  for (auto tet : part.tets) {
    for (auto& v : tet)
      v += n;
    two.tets.push_back(tet);
  }
  const std::string pieces = msh2(two, false);
  std::string entities = pieces; // the same with each piece a volume of its own
  for (std::size_t t = part.tets.size(); t < two.tets.size(); ++t) {
    const std::string line = fmt::format("\n{} 4 2 1 ", t + 1);
    const auto at = entities.find(line);
    ASSERT_NE(at, std::string::npos);
    entities[at + line.size()] = '2';
  }
  for (const std::string& text : {pieces, entities}) {
    GeometrySource source{.file = write("two.msh", text), .unit = "m"};
    EXPECT_SAYS(complaint(source),
                "2 separate solids in the file: 1 of volume 1 from (0, 0, 0) to (1, 1, 1); 2 of");
    source.solid = 2;
    const Domain domain = import(source);
    EXPECT_NEAR(domain.volume, 1, 1e-14);
    EXPECT_NEAR(domain.lower[0], 3, 1e-15);
    EXPECT_EQ(domain.vertices.size(), part.vertices.size());
    source.solid = 3;
    EXPECT_SAYS(complaint(source), "solid is 3, but there are 2");
  }
  // Two volumes that hang together are one body, unless one of them is asked for.
  std::string halves = msh2(part, false);
  const auto at = halves.find("\n3 4 2 1 ");
  halves[at + 9] = '2';
  GeometrySource source{.file = write("halves.msh", halves), .unit = "m"};
  EXPECT_NEAR(import(source).volume, 1, 1e-14);
  source.solid = 2;
  EXPECT_NEAR(import(source).volume, 1.0 / 6, 1e-14);
}

TEST_F(ImportMeshes, msh_of_something_else_is_refused) {
  const Domain part = test::box_domain();
  const std::string text = msh2(part, true);
  std::string surface_only = text, head = text.substr(0, text.find("$Elements"));
  EXPECT_SAYS(complaint(write("flat.msh", head + "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n")),
              "no tetrahedra");
  EXPECT_SAYS(complaint(write("hex.msh", head + "$Elements\n1\n1 5 2 1 1 1 2 4 3 5 6 8 7\n$EndElements\n")),
              "four-node tetrahedra");
  EXPECT_NE(complaint(write("cut.msh", text.substr(0, text.size() / 2))), "");
  Domain flat = part;
  flat.tets.push_back({0, 1, 2, 3});
  flat.vertices[flat.tets.back()[3]] = flat.vertices[flat.tets.back()[0]];
  EXPECT_NE(complaint(write("squashed.msh", msh2(flat, false))), "");
}

} // namespace
} // namespace tessera::preprocess
