#include "tests/support/domains.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <numbers>

namespace tessera::preprocess {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

class ImportMeshes : public ImportFixture {};

/// Boundary of a domain as STL.
std::string text_stl(const Domain& domain) {
  std::string text = "solid part\n";
  for (const auto& facet : domain.facets) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const auto v : facet.vertices)
      text += fmt::format("   vertex {:.9e} {:.9e} {:.9e}\n", domain.vertices[v][0], domain.vertices[v][1],
                          domain.vertices[v][2]);
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid part\n";
}

std::string binary_stl(const Domain& domain) {
  std::string bytes = "solid as some binary files begin";
  bytes.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(domain.facets.size());
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& facet : domain.facets) {
    bytes.append(12, '\0');
    for (const auto v : facet.vertices)
      for (int c = 0; c < 3; ++c) {
        const auto x = static_cast<float>(domain.vertices[v][c]);
        bytes.append(reinterpret_cast<const char*>(&x), 4);
      }
    bytes.append(2, '\0');
  }
  return bytes;
}

/// Tetrahedra as a gmsh mesh of version 2.2; the boundary triangles, too, when asked for.
std::string msh2(const Domain& domain, bool triangles) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (triangles) {
    text += fmt::format("$PhysicalNames\n{}\n", domain.surfaces.size());
    for (std::size_t s = 0; s < domain.surfaces.size(); ++s)
      text += fmt::format("2 {} \"{}\"\n", s + 1, domain.surfaces[s]);
    text += "$EndPhysicalNames\n";
  }
  text += fmt::format("$Nodes\n{}\n", domain.vertices.size());
  for (std::size_t v = 0; v < domain.vertices.size(); ++v)
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", v + 1, domain.vertices[v][0], domain.vertices[v][1],
                        domain.vertices[v][2]);
  text +=
      fmt::format("$EndNodes\n$Elements\n{}\n", domain.tets.size() + (triangles ? domain.facets.size() : 0));
  std::size_t n = 0;
  if (triangles)
    for (const auto& f : domain.facets)
      text += fmt::format("{} 2 2 {} {} {} {} {}\n", ++n, f.surface + 1, f.surface + 1, f.vertices[0] + 1,
                          f.vertices[1] + 1, f.vertices[2] + 1);
  for (const auto& t : domain.tets)
    text += fmt::format("{} 4 2 1 1 {} {} {} {}\n", ++n, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  return text + "$EndElements\n";
}

// ---- stereolithography

TEST_F(ImportMeshes, stl_text_and_binary_give_the_body_back) {
  const Domain part = test::l_domain(2, 8); // floats hold its coordinates
  for (const fs::path& file : {write("text.stl", text_stl(part)), write("binary.STL", binary_stl(part))}) {
    const Domain domain = import(file, "mm");
    EXPECT_NEAR(domain.volume / (3 * 512e-9), 1, 1e-12) << file;
    EXPECT_EQ(domain.cad_volume, domain.volume);
    EXPECT_EQ(domain.surfaces.size(), 8u);
    EXPECT_EQ(domain.groups.size(), 8u);
    EXPECT_EQ(domain.corners.size(), 12u);
    EXPECT_EQ(curves(domain), 18u);
    EXPECT_EQ(domain.facets.size(), part.facets.size());
  }
}

TEST_F(ImportMeshes, stl_turned_inside_out_is_turned_back) {
  Domain part = test::box_domain(Vec3(1, 2, 3), Vec3(2, 4, 6), 2);
  for (auto& facet : part.facets)
    std::swap(facet.vertices[0], facet.vertices[1]);
  std::swap(part.facets[3].vertices[0], part.facets[3].vertices[1]); // and one of them once more
  EXPECT_NEAR(import(write("inside_out.stl", text_stl(part)), "m").volume, 6, 1e-12);
}

TEST_F(ImportMeshes, open_stl_says_how_many_edges_and_where) {
  Domain part = test::box_domain(Vec3::Zero(), Vec3(4, 4, 4), 2);
  std::erase_if(part.facets, [&](const auto& facet) {
    return part.surfaces[facet.surface] == "zmax" && part.vertices[facet.vertices[0]][0] < 3 &&
           part.vertices[facet.vertices[1]][0] < 3 && part.vertices[facet.vertices[2]][0] < 3;
  });
  const std::string said = complaint(write("open.stl", text_stl(part)));
  EXPECT_SAYS(said, "open");
  EXPECT_SAYS(said, "6 of its edges");
  EXPECT_SAYS(said, ", 4)"); // the hole is in z = 4
  EXPECT_EQ(said.find('\n'), std::string::npos);
}

TEST_F(ImportMeshes, stl_that_is_not_whole_is_refused) {
  const Domain part = test::box_domain();
  const std::string text = text_stl(part), bytes = binary_stl(part);
  EXPECT_SAYS(complaint(write("a.stl", text.substr(0, text.size() - 40))), "cut off");
  EXPECT_SAYS(complaint(write("b.stl", bytes.substr(0, bytes.size() - 1))), "cut off");
  EXPECT_SAYS(complaint(write("c.stl", "solid nothing\nendsolid\n")), "STL");
  EXPECT_SAYS(complaint(write("d.stl", "Wer reitet so spaet")), "too short");
  EXPECT_SAYS(complaint(write("e.stl", "solid x\n facet normal 0 0 0 outer loop vertex 0 nan 0\n")),
              "cut off");
  std::string bad = text;
  bad.replace(bad.find("vertex ") + 7, 3, "x.x");
  EXPECT_SAYS(complaint(write("f.stl", bad)), "not a coordinate");
  bad = text;
  bad.replace(bad.find("vertex ") + 7, 3, "nan");
  EXPECT_NE(complaint(write("g.stl", bad)), "");
}

TEST_F(ImportMeshes, stl_cavity_and_separate_bodies_are_told_apart) {
  const Domain outer = test::box_domain(Vec3::Zero(), Vec3(3, 3, 3), 1);
  const auto both = [&](const Domain& other) {
    std::string text = text_stl(outer);
    text.erase(text.find("endsolid"));
    const std::string more = text_stl(other);
    return text + more.substr(more.find('\n') + 1);
  };
  EXPECT_NEAR(
      import(write("hollow.stl", both(test::box_domain(Vec3(1, 1, 1), Vec3(2, 2, 2), 1))), "m").volume, 26,
      1e-11);
  EXPECT_SAYS(complaint(write("two.stl", both(test::box_domain(Vec3(4, 0, 0), Vec3(5, 1, 1), 1)))),
              "2 separate bodies");
}

TEST_F(ImportMeshes, smooth_stl_surface_is_one_face) {
  // A ball of 32 by 64 patches, by hand.
  const int rows = 32, turns = 64;
  const auto at = [&](int i, int j) {
    const double theta = pi * i / rows, phi = 2 * pi * (j % turns) / turns;
    return i == 0 ? Vec3(0, 0, 1)
           : i == rows
               ? Vec3(0, 0, -1)
               : Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  Domain ball;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto v = static_cast<std::int32_t>(ball.vertices.size());
    ball.vertices.insert(ball.vertices.end(), {a, b, c});
    ball.facets.push_back({{v, v + 1, v + 2}, 0, 0});
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < turns; ++j) {
      if (i > 0)
        add(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i + 1 < rows)
        add(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
    }
  const Domain domain = import(write("ball.stl", binary_stl(ball)), "m");
  EXPECT_NEAR(domain.volume / (4 * pi / 3), 1, 1e-2);
  EXPECT_EQ(domain.surfaces.size(), 1u);
  EXPECT_TRUE(domain.feature_edges.empty());
  EXPECT_TRUE(domain.corners.empty());
}

// ---- gmsh meshes

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

TEST_F(ImportMeshes, msh_of_something_else_is_refused) {
  const Domain part = test::box_domain();
  const std::string text = msh2(part, true);
  std::string surface_only = text, head = text.substr(0, text.find("$Elements"));
  EXPECT_SAYS(complaint(write("flat.msh", head + "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n")),
              "no tetrahedra");
  EXPECT_SAYS(complaint(write("hex.msh", head + "$Elements\n1\n1 5 2 1 1 1 2 4 3 5 6 8 7\n$EndElements\n")),
              "four-node tetrahedra");
  EXPECT_NE(complaint(write("cut.msh", text.substr(0, text.size() / 2))), "");
  Domain two = part;
  for (const Vec3& X : part.vertices)
    two.vertices.push_back(X + Vec3(3, 0, 0));
  const auto n = static_cast<std::int32_t>(part.vertices.size());
  for (auto tet : part.tets) {
    for (auto& v : tet)
      v += n;
    two.tets.push_back(tet);
  }
  EXPECT_SAYS(complaint(write("two.msh", msh2(two, false))), "2 separate bodies");
  Domain flat = part;
  flat.tets.push_back({0, 1, 2, 3});
  flat.vertices[flat.tets.back()[3]] = flat.vertices[flat.tets.back()[0]];
  EXPECT_NE(complaint(write("squashed.msh", msh2(flat, false))), "");
}

} // namespace
} // namespace tessera::preprocess
