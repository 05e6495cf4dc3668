#include "core/interrupt.hpp"
#include "preprocess/geometry/domain_stream.hpp"
#include "tests/support/processes.hpp"
#include "tests/unit/preprocess/geometry/import_fixture.hpp"

#include <chrono>
#include <csignal>
#include <numbers>
#include <thread>
#include <unistd.h>

namespace tessera::preprocess {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

const fs::path geometries = fs::path(TESSERA_SOURCE_DIR) / "geometries";
const fs::path taylor_bar = geometries / "taylor_bar" / "taylor_bar.step";
const fs::path bracket = geometries / "bracket" / "bracket.step";
const fs::path cube = geometries / "spinning_cube" / "cube.geo";

class Import : public ImportFixture {};

// ---- shapes and sizes

TEST_F(Import, taylor_bar_has_its_volume_and_two_rims) {
  const double exact = pi * 3.2e-3 * 3.2e-3 * 32e-3;
  const Domain domain = import(taylor_bar, "mm");
  EXPECT_NEAR(domain.cad_volume / exact, 1, 1e-6);
  EXPECT_LT(std::abs(domain.volume / domain.cad_volume - 1), 1e-3);
  EXPECT_LT(domain.volume, domain.cad_volume); // chords lie inside
  EXPECT_NEAR(domain.lower[2], 0, 1e-12);
  EXPECT_NEAR(domain.upper[2], 32e-3, 1e-12);
  EXPECT_NEAR(domain.upper[0], 3.2e-3, 1e-8);
  EXPECT_EQ(domain.surfaces.size(), 3u);
  EXPECT_EQ(curves(domain), 2u);
  EXPECT_TRUE(domain.corners.empty());
  for (const auto& edge : domain.feature_edges)
    for (const auto v : edge.vertices) {
      const Vec3& X = domain.vertices[v];
      EXPECT_NEAR(std::hypot(X[0], X[1]), 3.2e-3, 1e-9);
      EXPECT_TRUE(std::abs(X[2]) < 1e-12 || std::abs(X[2] - 32e-3) < 1e-12);
    }
}

TEST_F(Import, tighter_tolerance_is_met) {
  const fs::path file = write("disc.geo", "SetFactory(\"OpenCASCADE\"); Cylinder(1) = {0,0,0, 0,0,1, 2};");
  for (const double tolerance : {1e-2, 2e-4}) {
    const Domain domain = import(file, "cm", tolerance);
    EXPECT_LT(std::abs(domain.volume / domain.cad_volume - 1), tolerance);
    EXPECT_NEAR(domain.cad_volume / (4 * pi * 1e-6), 1, 1e-6);
  }
}

TEST_F(Import, bracket_is_not_convex_and_keeps_every_corner) {
  const double profile = 60 * 6 + 44 * 6 + (1 - pi / 4) * (6 * 6 - 9 * 9);
  const double exact = (profile * 40 - 2 * pi * 3.3 * 3.3 * 6 - pi * 8 * 8 * 6) * 1e-9;
  const Domain domain = import(bracket, "mm");
  EXPECT_NEAR(domain.cad_volume / exact, 1, 1e-6);
  EXPECT_LT(std::abs(domain.volume / domain.cad_volume - 1), 1e-3);
  EXPECT_EQ(domain.surfaces.size(), 13u);
  EXPECT_EQ(domain.corners.size(), 16u);
  EXPECT_EQ(curves(domain), 30u);
  EXPECT_NEAR(domain.upper[0] - domain.lower[0], 60e-3, 1e-9);
  EXPECT_NEAR(domain.upper[1] - domain.lower[1], 40e-3, 1e-9);
  EXPECT_NEAR(domain.upper[2] - domain.lower[2], 50e-3, 1e-9);
}

TEST_F(Import, planar_part_is_exact) {
  const Domain domain = import(cube, "m");
  EXPECT_NEAR(domain.volume, 1, 1e-12);
  EXPECT_NEAR(domain.volume / domain.cad_volume, 1, 1e-12);
  EXPECT_EQ(domain.corners.size(), 8u);
  EXPECT_EQ(curves(domain), 12u);
  const auto area = areas(domain);
  for (const char* face : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"})
    EXPECT_NEAR(area.at(face), 1, 1e-12) << face;
  for (const auto& facet : domain.facets) {
    if (facet.surface != group_named(domain, "zmax").surfaces.at(0))
      continue;
    EXPECT_NEAR(domain.vertices[facet.vertices[0]][2], 0.5, 1e-12);
  }
}

TEST_F(Import, sphere_and_torus_have_no_features_and_a_cone_has_a_tip) {
  const std::string head = "SetFactory(\"OpenCASCADE\"); ";
  const Domain ball = import(write("ball.geo", head + "Sphere(1) = {0,0,0, 1};"), "m", 1e-2);
  EXPECT_TRUE(ball.feature_edges.empty());
  EXPECT_TRUE(ball.corners.empty());
  EXPECT_NEAR(ball.cad_volume, 4 * pi / 3, 1e-6);
  const Domain ring = import(write("ring.geo", head + "Torus(1) = {0,0,0, 3, 1};"), "m", 1e-2);
  EXPECT_TRUE(ring.feature_edges.empty());
  EXPECT_TRUE(ring.corners.empty());
  EXPECT_NEAR(ring.cad_volume, 2 * pi * pi * 3, 1e-4);
  const Domain cone = import(write("cone.geo", head + "Cone(1) = {0,0,0, 0,0,2, 1, 0};"), "m", 1e-2);
  ASSERT_EQ(cone.corners.size(), 1u);
  EXPECT_NEAR((cone.vertices[cone.corners[0]] - Vec3(0, 0, 2)).norm(), 0, 1e-12);
  EXPECT_EQ(curves(cone), 1u);
}

TEST_F(Import, cavity_counts_as_outside) {
  const Domain domain =
      import(write("hollow.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0,3,3,3}; "
                                 "Box(2) = {1,1,1,1,1,1}; "
                                 "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }"),
             "m");
  EXPECT_NEAR(domain.volume, 26, 1e-11);
  EXPECT_EQ(domain.corners.size(), 16u);
}

TEST_F(Import, gmsh_own_kernel_with_curved_faces_is_refined_without_a_reference) {
  const Domain domain = import(write("own.geo", R"(
    Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {0,1,0}; Point(4) = {-1,0,0}; Point(5) = {0,-1,0};
    Circle(1) = {2,1,3}; Circle(2) = {3,1,4}; Circle(3) = {4,1,5}; Circle(4) = {5,1,2};
    Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
    Extrude {0,0,1} { Surface{1}; }
    Physical Curve("rim") = {1,2,3,4}; Physical Point("start") = {2}; Physical Surface("floor") = {1};)"),
                               "m");
  EXPECT_NEAR(domain.volume / pi, 1, 1e-3);
  EXPECT_NEAR(domain.cad_volume / pi, 1, 1e-4);
  EXPECT_EQ(domain.surfaces.size(), 6u);
  ASSERT_EQ(domain.groups.size(), 3u);
  EXPECT_EQ(group_named(domain, "rim").curves.size(), 4u);
  EXPECT_EQ(group_named(domain, "start").vertices.size(), 1u);
  EXPECT_EQ(group_named(domain, "floor").surfaces.size(), 1u);
  EXPECT_NEAR(areas(domain).at("floor"), pi, 1e-2);
}

TEST_F(Import, same_file_same_bits) {
  for (const fs::path& file : {taylor_bar, bracket}) {
    const Domain one = import(file, "mm", 3e-3), two = import(file, "mm", 3e-3);
    EXPECT_TRUE(to_bytes(one) == to_bytes(two)) << file;
  }
}

// ---- units

TEST_F(Import, step_carries_its_own_unit_into_the_case) {
  for (const char* unit : {"m", "cm", "um", "in"}) {
    std::ostringstream said;
    Progress progress(said, false, false);
    const Domain domain = import_geometry({.file = taylor_bar, .unit = unit, .tolerance = 1e-2}, progress);
    EXPECT_NEAR(domain.upper[2], 32e-3, 1e-12) << unit;
    EXPECT_SAYS(said.str(), "written in mm");
  }
}

TEST_F(Import, step_written_in_other_units_has_its_right_size) {
  const std::string mm = slurp(taylor_bar), here = "SI_UNIT(.MILLI.,.METRE.)";
  const auto at = mm.find(here);
  ASSERT_NE(at, std::string::npos);
  for (const auto& [unit, metres] :
       std::map<std::string, double>{{"$", 1.0}, {".CENTI.", 1e-2}, {".MICRO.", 1e-6}}) {
    std::string other = mm;
    other.replace(at, here.size(), "SI_UNIT(" + unit + ",.METRE.)");
    const Domain domain = import(write("other.step", other), "mm", 1e-2);
    EXPECT_NEAR(domain.upper[2] / (32 * metres), 1, 1e-9) << unit;
  }
}

TEST_F(Import, plain_numbers_take_the_stated_unit) {
  const fs::path file = write("block.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {1,1,1, 2,3,4};");
  for (const auto& [unit, metres] :
       std::map<std::string, double>{{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}}) {
    const Domain domain = import(file, unit);
    EXPECT_NEAR(domain.volume / (24 * metres * metres * metres), 1, 1e-12) << unit;
    EXPECT_NEAR(domain.lower[0] / metres, 1, 1e-12);
    EXPECT_NEAR(domain.upper[2] / metres, 5, 1e-12);
  }
  EXPECT_THROW(metres_per_unit("furlong"), InputError);
  EXPECT_THROW(metres_per_unit(""), InputError);
}

TEST_F(Import, says_unit_extent_and_both_volumes) {
  std::ostringstream said;
  Progress progress(said, false, false);
  import_geometry({.file = taylor_bar, .unit = "mm", .tolerance = 1e-2}, progress);
  EXPECT_SAYS(said.str(), "32) mm");
  EXPECT_SAYS(said.str(), "by the CAD");
  EXPECT_EQ(said.str().find("not in"), std::string::npos);
}

// ---- names

TEST_F(Import, step_face_names_become_groups) {
  std::string text = slurp(taylor_bar);
  int n = 0;
  const char* names[] = {"mantle", "top", "foot"};
  for (auto at = text.find("ADVANCED_FACE('"); at != std::string::npos && n < 3;
       at = text.find("ADVANCED_FACE('", at + 1))
    text.insert(at + 15, names[n++]);
  ASSERT_EQ(n, 3);
  const Domain domain = import(write("named.step", text), "mm", 1e-2);
  const auto area = areas(domain);
  ASSERT_TRUE(area.contains("mantle") && area.contains("top") && area.contains("foot"));
  EXPECT_NEAR(area.at("mantle") / (2 * pi * 3.2e-3 * 32e-3), 1, 2e-2);
  for (const auto& [name, height] : std::map<std::string, double>{{"top", 32e-3}, {"foot", 0}})
    for (const auto& facet : domain.facets) {
      if (facet.surface != group_named(domain, name).surfaces.at(0))
        continue;
      EXPECT_NEAR(domain.vertices[facet.vertices[0]][2], height, 1e-12);
    }
}

TEST_F(Import, faces_without_names_are_numbered_and_each_a_group) {
  const Domain domain = import(taylor_bar, "mm", 1e-2);
  EXPECT_EQ(domain.surfaces, (std::vector<std::string>{"face1", "face2", "face3"}));
  EXPECT_EQ(domain.groups.size(), 3u);
}

// ---- bad files

TEST_F(Import, files_that_are_not_there_or_not_files) {
  EXPECT_SAYS(complaint(folder() / "nowhere.step"), "no such geometry file");
  fs::create_directory(folder() / "part.step");
  EXPECT_SAYS(complaint(folder() / "part.step"), "folder");
  EXPECT_SAYS(complaint(write("empty.step", "")), "empty");
  EXPECT_SAYS(complaint(write("part.igess", "x")), ".step, .stp, .iges");
  EXPECT_SAYS(complaint(write("part", "x")), "no extension");
  EXPECT_SAYS(complaint(write("poem.step", "Wer reitet so spaet")), "not a STEP file");
  EXPECT_SAYS(complaint(write("poem.brep", "Wer reitet so spaet")), "not an OpenCASCADE");
  EXPECT_SAYS(complaint(write("evil.msh", "SystemCall \"true\";")), "not a gmsh mesh");
  EXPECT_SAYS(complaint(write("old.msh", "$MeshFormat\n1 0 8\n$EndMeshFormat\n")), "version 1");
}

TEST_F(Import, truncated_step_is_refused_at_any_length) {
  const std::string text = slurp(taylor_bar);
  for (const double part : {0.001, 0.02, 0.3, 0.7, 0.95, 0.999})
    EXPECT_NE(complaint(write("cut.step", text.substr(0, static_cast<std::size_t>(part * text.size())))), "")
        << part;
  // Cut off in the middle, but with its last line: the reader itself must find out.
  for (const double part : {0.02, 0.3, 0.7})
    EXPECT_NE(complaint(write("cut.step", text.substr(0, static_cast<std::size_t>(part * text.size())) +
                                              "\nENDSEC;\nEND-ISO-10303-21;\n")),
              "")
        << part;
}

TEST_F(Import, step_with_an_empty_shell_is_refused) {
  std::string text = slurp(taylor_bar);
  const auto at = text.find("CLOSED_SHELL('',(") + 17;
  text.erase(at, text.find(')', at) - at);
  EXPECT_NE(complaint(write("hollow.step", text)), "");
}

TEST_F(Import, one_of_several_solids_is_chosen) {
  // Two of them touch; the loose surface is no solid.
  GeometrySource source{.file = occ("three.geo", R"(
    Box(1) = {0,0,0, 1,1,1}; Box(2) = {1,0,0, 2,1,1}; Cylinder(3) = {9,0,0, 0,0,1, 0.5};
    BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; } Rectangle(99) = {0,0,9, 1,1};
    Physical Volume("left") = {1}; Physical Volume("right") = {2}; Physical Volume("bar") = {3};
    f() = Surface In BoundingBox{0.9,-0.1,-0.1, 1.1,1.1,1.1}; Physical Surface("joint") = {f()};
    e() = Surface In BoundingBox{2.9,-0.1,-0.1, 3.1,1.1,1.1}; Physical Surface("end") = {e()};)"),
                        .unit = "m"};
  const std::string said = complaint(source);
  EXPECT_SAYS(said, "there are 3 solids in the file: 1 of volume 1 from (");
  EXPECT_SAYS(said, "; 3 of volume 0.7854 from (8.5");
  EXPECT_SAYS(said, "choose one with [geometry] solid = N");
  const std::vector<std::vector<std::string>> groups{{"joint", "left"}, {"end", "joint", "right"}, {"bar"}};
  for (const double volume : {1.0, 2.0, pi / 4}) {
    ++source.solid;
    const Domain domain = import(source);
    EXPECT_NEAR(domain.cad_volume, volume, 1e-9);
    std::vector<std::string> names;
    for (const auto& group : domain.groups)
      names.push_back(group.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, groups.at(static_cast<std::size_t>(source.solid) - 1));
    EXPECT_EQ(domain.corners.size(), source.solid < 3 ? 8u : 0u);
  }
  ++source.solid;
  EXPECT_SAYS(complaint(source), "solid is 4, but there are 3 solids");
}

TEST_F(Import, bodies_are_counted) {
  const std::string head = "SetFactory(\"OpenCASCADE\"); ";
  EXPECT_SAYS(complaint(write("two.geo", head + "Box(1) = {0,0,0,1,1,1}; Box(2) = {2,0,0,1,1,1};")),
              "2 solids");
  EXPECT_SAYS(complaint(write("flat.geo", head + "Rectangle(1) = {0,0,0,1,1};")), "no solid");
  EXPECT_SAYS(complaint(write("none.geo", head + "a = 1;")), "no body");
  EXPECT_SAYS(complaint(write("wrong.geo", "Point(1) = {0,0;")), "cannot read");
}

// ---- the importer's own end

TEST_F(Import, crash_becomes_an_error) {
  stand_in("echo some words; kill -SEGV $$");
  const std::string said = complaint(taylor_bar);
  EXPECT_SAYS(said, "crashed");
  EXPECT_SAYS(said, "Segmentation fault");
  EXPECT_SAYS(said, "some words");
}

TEST_F(Import, time_limit_ends_the_importer_and_its_children) {
  stand_in("sleep 300 & echo $! > " + (folder() / "child").string() + "; sleep 300");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_SAYS(complaint({.file = taylor_bar, .unit = "mm", .seconds = 0.5}),
              "longer than its limit of 0.5 s");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  const std::string child = slurp(folder() / "child");
  ASSERT_FALSE(child.empty());
  EXPECT_TRUE(test::ends_within_two_seconds(std::stoi(child)));
}

TEST_F(Import, real_importer_keeps_to_its_time_limit) {
  EXPECT_SAYS(complaint({.file = taylor_bar, .unit = "mm", .tolerance = 1e-5, .seconds = 0.2}),
              "longer than its limit");
}

TEST_F(Import, real_importer_keeps_to_its_memory_limit) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "a sanitized program cannot live under a limit of its address space";
#endif
  EXPECT_SAYS(
      complaint({.file = taylor_bar, .unit = "mm", .tolerance = 1e-4, .bytes = std::uint64_t{150} << 20}),
      "memory limit of 150 MiB");
}

TEST_F(Import, interruption_ends_the_importer) {
  stand_in("sleep 300");
  const auto interrupt_while_importing = [] {
    catch_interrupts();
    std::thread user([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      ::kill(::getpid(), SIGINT);
    });
    int status = 0;
    try {
      import(taylor_bar, "mm");
    } catch (const RunError& error) {
      status = std::string(error.what()).find("interrupted") != std::string::npos ? 7 : 1;
    }
    user.join();
    std::_Exit(status);
  };
  EXPECT_EXIT(interrupt_while_importing(), testing::ExitedWithCode(7), "");
}

TEST_F(Import, short_altered_or_missing_answers_are_errors) {
  const std::string output = "for a in \"$@\"; do case $a in output=*) out=${a#output=};; esac; done; ";
  stand_in("exit 0");
  EXPECT_SAYS(complaint(taylor_bar), "no usable answer");
  stand_in(output + "printf TESSDOM2 > \"$out\"");
  EXPECT_SAYS(complaint(taylor_bar), "ends early");
  stand_in(output + "head -c 100000 /dev/zero > \"$out\"");
  EXPECT_SAYS(complaint(taylor_bar), "not a domain");
  stand_in("echo what a pity; exit 9");
  EXPECT_SAYS(complaint(taylor_bar), "status 9");
  EXPECT_SAYS(complaint(taylor_bar), "what a pity");
  stand_in("exit 4"); // its disk is full: not the part's fault
  EXPECT_THROW(import(taylor_bar, "mm"), RunError);
  ::setenv("TESSERA_LIBEXEC", (folder() / "nothing").c_str(), 1);
  EXPECT_THROW(import(taylor_bar, "mm"), RunError);
}

TEST_F(Import, output_without_end_neither_blocks_nor_fills_the_memory) {
  stand_in("yes | head -c 50000000; exit 5");
  EXPECT_SAYS(complaint(taylor_bar), "status 5");
}

} // namespace
} // namespace tessera::preprocess
