#include "preprocess/geometry/domain_stream.hpp"
#include "tests/support/domains.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"
#include "tests/unit/preprocess/geometry/mesh_files.hpp"

#include <numbers>

namespace tessera::preprocess {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;
using test::binary_stl;
using test::text_stl;

class ImportSurfaces : public ImportFixture {
 protected:
  static GeometrySource closing(const fs::path& file, int close_holes) {
    GeometrySource source{.file = file, .unit = "m"};
    source.close_holes = close_holes;
    return source;
  }
};

TEST_F(ImportSurfaces, stl_text_and_binary_give_the_body_back) {
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

TEST_F(ImportSurfaces, stl_turned_inside_out_is_turned_back) {
  Domain part = test::box_domain(Vec3(1, 2, 3), Vec3(2, 4, 6), 2);
  for (auto& facet : part.facets)
    std::swap(facet.vertices[0], facet.vertices[1]);
  std::swap(part.facets[3].vertices[0], part.facets[3].vertices[1]); // and one of them once more
  EXPECT_NEAR(import(write("inside_out.stl", text_stl(part)), "m").volume, 6, 1e-12);
}

TEST_F(ImportSurfaces, open_stl_says_how_many_edges_and_where) {
  Domain part = test::box_domain(Vec3::Zero(), Vec3(4, 4, 4), 2);
  std::erase_if(part.facets, [&](const auto& facet) {
    return part.surfaces[facet.surface] == "zmax" && part.vertices[facet.vertices[0]][0] < 3 &&
           part.vertices[facet.vertices[1]][0] < 3 && part.vertices[facet.vertices[2]][0] < 3;
  });
  const std::string said = complaint(write("open.stl", text_stl(part)));
  EXPECT_SAYS(said, "open: 1 hole, the largest of 6 edges near (1, 2, 4)");
  EXPECT_SAYS(said, "close_holes = N");
}

TEST_F(ImportSurfaces, stl_that_is_not_whole_is_refused) {
  const Domain part = test::box_domain();
  const std::string text = text_stl(part), bytes = binary_stl(part);
  EXPECT_SAYS(complaint(write("a.stl", text.substr(0, text.size() - 40))), "cut off");
  EXPECT_SAYS(complaint(write("b.stl", bytes.substr(0, bytes.size() - 1))), "cut off");
  EXPECT_SAYS(complaint(write("c.stl", "solid nothing\nendsolid\n")), "STL");
  EXPECT_SAYS(complaint(write("d.stl", "Wer reitet so spaet")), "STL");
  EXPECT_SAYS(complaint(write("e.stl", "solid x\n facet normal 0 0 0 outer loop vertex 0 nan 0\n")), "STL");
  for (const char* word : {"x.x", "nan", "1e999", "inf"}) {
    std::string bad = text;
    bad.replace(bad.find("vertex ") + 7, 3, word);
    EXPECT_SAYS(complaint(write("f.stl", bad)), "STL") << word;
  }
  std::string nan = bytes;
  nan.replace(84 + 12, 4, "\xff\xff\xff\xff");
  EXPECT_SAYS(complaint(write("g.stl", nan)), "not a number");
}

TEST_F(ImportSurfaces, stl_cavity_and_separate_bodies_are_told_apart) {
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
              "2 separate solids");
}

TEST_F(ImportSurfaces, smooth_stl_surface_is_one_face) {
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

TEST_F(ImportSurfaces, stl_in_capitals_is_read) {
  std::string text = text_stl(test::box_domain());
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  EXPECT_NEAR(import(write("loud.stl", text), "m").volume, 1, 1e-12);
}

TEST_F(ImportSurfaces, corners_rounded_anew_are_one_vertex) {
  // Each triangle's corners a little elsewhere, as programs write them that keep no vertices.
  const Domain part = test::l_domain(2);
  Domain loose;
  for (std::size_t f = 0; f < part.facets.size(); ++f) {
    const auto v = static_cast<std::int32_t>(loose.vertices.size());
    for (int k = 0; k < 3; ++k)
      loose.vertices.push_back(part.vertices[part.facets[f].vertices[k]] +
                               1e-8 *
                                   Vec3(std::sin(1.0 + v + k), std::cos(2.0 * v + k), std::sin(3.0 * v - k)));
    loose.facets.push_back({{v, v + 1, v + 2}, 0, 0});
  }
  const Domain domain = import(write("loose.stl", text_stl(loose)), "m");
  EXPECT_NEAR(domain.volume, 3, 1e-6);
  EXPECT_EQ(domain.facets.size(), part.facets.size());
  EXPECT_EQ(domain.corners.size(), 12u);
}

TEST_F(ImportSurfaces, obj_and_ply_give_the_body_back) {
  const Domain part = test::l_domain(2, 8);
  for (const auto& [name, text] : std::map<std::string, std::string>{{"part.obj", test::obj(part)},
                                                                     {"quads.obj", test::obj(part, true)},
                                                                     {"text.ply", test::ply(part, false)},
                                                                     {"binary.PLY", test::ply(part, true)}}) {
    const Domain domain = import(write(name, text), "mm");
    EXPECT_NEAR(domain.volume / (3 * 512e-9), 1, 1e-12) << name;
    EXPECT_EQ(domain.surfaces.size(), 8u);
    EXPECT_EQ(domain.corners.size(), 12u);
    EXPECT_EQ(curves(domain), 18u);
    EXPECT_EQ(domain.facets.size(), part.facets.size());
  }
  EXPECT_NE(test::obj(part, true).size(), test::obj(part).size());
}

TEST_F(ImportSurfaces, obj_and_ply_that_are_not_whole_are_refused) {
  const Domain part = test::box_domain();
  const std::string obj = test::obj(part), text = test::ply(part, false), bytes = test::ply(part, true);
  EXPECT_NE(complaint(write("a.obj", obj.substr(0, obj.size() / 2))), "");
  EXPECT_NE(complaint(write("b.ply", text.substr(0, text.size() / 2))), "");
  EXPECT_NE(complaint(write("c.ply", bytes.substr(0, bytes.size() - 5))), "");
  EXPECT_SAYS(complaint(write("d.obj", obj + "f 1 2 99\n")), "OBJ");
  EXPECT_SAYS(complaint(write("e.obj", obj + "f 1 -99 2\n")), "OBJ");
  std::string astray = text;
  astray.replace(astray.rfind(' '), std::string::npos, " 99\n");
  EXPECT_SAYS(complaint(write("j.ply", astray)), "PLY");
  EXPECT_SAYS(complaint(write("f.obj", "Wer reitet so spaet\n")), "OBJ");
  EXPECT_SAYS(complaint(write("g.ply", "Wer reitet so spaet\n")), "PLY");
  std::string many = bytes;
  many.replace(many.find("vertex 8"), 8, "vertex 888888888888");
  EXPECT_NE(complaint(write("h.ply", many)), "");
  std::string headless = text;
  headless.erase(headless.find("element vertex"), 17);
  EXPECT_SAYS(complaint(write("k.ply", headless)), "no PLY file");
  std::string bad = obj;
  bad.replace(bad.find("v ") + 2, 1, "nan");
  EXPECT_SAYS(complaint(write("i.obj", bad)), "OBJ");
}

TEST_F(ImportSurfaces, small_holes_are_closed_when_asked) {
  Domain part = test::box_domain(Vec3::Zero(), Vec3(4, 4, 4), 2);
  const auto without = [&](auto&& gone) {
    Domain open = part;
    std::erase_if(open.facets, gone);
    return text_stl(open);
  };
  const auto lid = [&](const auto& facet) { return part.surfaces[facet.surface] == "zmax"; };
  const fs::path one = write("one.stl", without([&, n = 0](const auto&) mutable { return n++ == 5; }));
  EXPECT_SAYS(complaint(closing(one, 0)), "1 hole, the largest of 3 edges");
  EXPECT_SAYS(complaint(closing(one, 2)), "close_holes = N (it is 2)");
  std::ostringstream said;
  Progress progress(said, false, false);
  EXPECT_NEAR(import_geometry(closing(one, 3), progress).volume, 64, 1e-10);
  EXPECT_SAYS(said.str(), "closed 1 hole in the surface, the largest of 3 edges");
  const fs::path open = write("open.stl", without(lid));
  EXPECT_SAYS(complaint(closing(open, 7)), "1 hole, the largest of 8 edges near (2, 2, 4)");
  EXPECT_NEAR(import(closing(open, 8)).volume, 64, 1e-10);
}

TEST_F(ImportSurfaces, what_is_not_manifold_is_said) {
  const Domain box = test::box_domain();
  const auto join = [&](const Domain& other) {
    Domain both = box;
    const auto n = static_cast<std::int32_t>(box.vertices.size());
    both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (auto facet : other.facets) {
      for (auto& v : facet.vertices)
        v += n;
      both.facets.push_back(facet);
    }
    return text_stl(both);
  };
  EXPECT_SAYS(complaint(write("edge.stl", join(test::box_domain(Vec3(1, 1, 0), Vec3(2, 2, 1))))),
              "1 edge with more than two triangles, the first with 4 near (1, 1, 0.5)");
  EXPECT_SAYS(complaint(write("corner.stl", join(test::box_domain(Vec3(1, 1, 1), Vec3(2, 2, 2))))),
              "touches itself in 1 point, the first near (1, 1, 1)");
  const std::string crossing =
      complaint(write("cross.stl", join(test::box_domain(Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2)))));
  EXPECT_SAYS(crossing, "the surface intersects itself: ");
  EXPECT_SAYS(crossing, " pairs of triangles, the first near (");

  Domain band; // Moebius'
  const int n = 6;
  for (int i = 0; i < n; ++i)
    for (const double r : {1.0, 2.0})
      band.vertices.emplace_back(r * std::cos(2 * pi * i / n), r * std::sin(2 * pi * i / n),
                                 0.1 * i * (r - 1.5));
  for (std::int32_t i = 0; i < n; ++i) {
    std::int32_t a = 2 * i, b = 2 * i + 1, c = 2 * ((i + 1) % n), d = c + 1;
    if (i + 1 == n)
      std::swap(c, d);
    band.facets.push_back({{a, c, b}, 0, 0});
    band.facets.push_back({{b, c, d}, 0, 0});
  }
  EXPECT_SAYS(complaint(write("band.stl", text_stl(band))), "only one side");
}

TEST_F(ImportSurfaces, one_of_several_solids_is_chosen) {
  // A block with a cavity that holds a block of its own, and another block beside.
  Domain all;
  for (const auto& [low, high] :
       {std::pair{Vec3(0, 0, 0), Vec3(5, 5, 5)}, std::pair{Vec3(7, 0, 0), Vec3(8, 1, 2)},
        std::pair{Vec3(1, 1, 1), Vec3(4, 4, 4)}, std::pair{Vec3(2, 2, 2), Vec3(3, 3, 3)}}) {
    const Domain box = test::box_domain(low, high);
    const auto n = static_cast<std::int32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), box.vertices.begin(), box.vertices.end());
    for (auto facet : box.facets) {
      for (auto& v : facet.vertices)
        v += n;
      all.facets.push_back(facet);
    }
  }
  GeometrySource source{.file = write("nested.stl", text_stl(all)), .unit = "m"};
  const std::string said = complaint(source);
  EXPECT_SAYS(
      said,
      "3 separate solids in the file: 1 of volume 98 from (0, 0, 0) to (5, 5, 5); 2 of volume 2 from (7,");
  for (const double volume : {98, 2, 1}) {
    ++source.solid;
    EXPECT_NEAR(import(source).volume, volume, 1e-10);
  }
  ++source.solid;
  EXPECT_SAYS(complaint(source), "solid is 4, but there are 3 separate solids");
}

TEST_F(ImportSurfaces, same_file_same_bits) {
  const auto file = write("part.stl", text_stl(test::l_domain(3)));
  EXPECT_TRUE(to_bytes(import(file)) == to_bytes(import(file)));
}

TEST_F(ImportSurfaces, are_no_plane_figures) {
  EXPECT_SAYS(complaint(write("part.stl", text_stl(test::box_domain())), 2), "no plane figure");
}

} // namespace
} // namespace tessera::preprocess
