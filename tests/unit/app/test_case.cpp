#include "core/error.hpp"
#include "tests/unit/app/case_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

TEST(Case, EveryStatedValueArrives) {
  const Case c = read_text_case(complete_case);
  EXPECT_EQ(c.title, "a bar");
  EXPECT_EQ(c.geometry.unit, "mm");
  EXPECT_EQ(c.particles.arrangement, preprocess::Arrangement::lattice);
  EXPECT_EQ(c.particles.spacing, 0.001);
  EXPECT_EQ(c.scene.material.density, 8930);
  EXPECT_EQ(c.scene.material.young, 117e9);
  EXPECT_EQ(c.scene.material.poisson, 0.35);
  EXPECT_FALSE(c.scene.material.plasticity.has_value());
  EXPECT_EQ(c.scene.end_time, 80e-6);
  ASSERT_EQ(c.scene.initial.size(), 1U);
  EXPECT_EQ(c.scene.initial[0].on, "all");
  EXPECT_EQ(c.scene.initial[0].velocity->at(1)(Vec3(0, 0, 3)), 5);
  EXPECT_EQ(c.scene.initial[0].velocity->at(2)(Vec3(0, 0, 3)), -227);
  ASSERT_EQ(c.scene.boundary.size(), 1U);
  EXPECT_EQ(c.scene.boundary[0].component, (std::array{true, true, true}));
  ASSERT_EQ(c.scene.walls.size(), 1U);
  EXPECT_EQ(c.scene.walls[0].shape->gap({1, 2, 3}).normal, Vec3::UnitZ());
  ASSERT_EQ(c.particles.sets.size(), 1U);
  EXPECT_EQ(c.scene.frames, 4);
  ASSERT_EQ(c.scene.probes.size(), 1U);
  EXPECT_EQ(c.scene.probes[0].reduce, "extent");
  ASSERT_EQ(c.pictures.size(), 1U);
  EXPECT_EQ(c.pictures[0].frame, "last");
}

TEST(Case, OptionalPartsArrive) {
  const Case c =
      read_text_case(with("poisson = 0.35", "poisson = 0.35\nplasticity = {yield = 4e8, hardening = 1e8}"),
                     {"geometry.tolerance=1e-4", "particles.seed=7", "solver.support=2.2", "solver.cfl=0.2",
                      "solver.momentum_projection=false", "wall.0.restitution=0.5"});
  ASSERT_TRUE(c.scene.material.plasticity.has_value());
  const auto& hardening = std::get<solver::LinearHardening>(*c.scene.material.plasticity);
  EXPECT_EQ(hardening.yield, 4e8);
  EXPECT_EQ(hardening.modulus, 1e8);
  EXPECT_EQ(c.geometry.tolerance, 1e-4);
  EXPECT_EQ(c.particles.seed, 7U);
  EXPECT_EQ(c.scene.support, 2.2);
  EXPECT_EQ(c.scene.cfl, 0.2);
  EXPECT_FALSE(c.scene.momentum_projection);
  EXPECT_EQ(c.scene.walls[0].restitution, 0.5);
}

TEST(Case, HardeningMayFollowAPower) {
  const Case c = read_text_case(
      with("poisson = 0.35",
           "poisson = 0.35\nplasticity.power = {coefficient = 159e6, offset = 0.02, exponent = 0.27}"));
  ASSERT_TRUE(c.scene.material.plasticity.has_value());
  const auto& hardening = std::get<solver::PowerHardening>(*c.scene.material.plasticity);
  EXPECT_EQ(hardening.coefficient, 159e6);
  EXPECT_EQ(hardening.offset, 0.02);
  EXPECT_EQ(hardening.exponent, 0.27);
}

constexpr const char* hencky_table = "law = \"hencky\"\ndensity = 8930\nyoung = 117e9\npoisson = 0.35";

TEST(Case, EachLawReadsItsOwnConstants) {
  const auto material = [](const std::string& lines) {
    return read_text_case(with(hencky_table, lines)).scene.material;
  };
  for (const char* law : {"linear_elastic", "saint_venant_kirchhoff", "neo_hookean"}) {
    const auto m =
        material("law = \"" + std::string(law) + "\"\ndensity = 1100\nyoung = 17e6\npoisson = 0.3");
    EXPECT_EQ(m.law, law);
    EXPECT_EQ(m.young, 17e6);
    EXPECT_EQ(m.poisson, 0.3);
  }
  for (const char* constants : {"c1 = 2e6\nc2 = 0.5e6", "mu1 = 4e6\nmu2 = -1e6"}) {
    const auto m = material("law = \"mooney_rivlin\"\ndensity = 1100\nbulk = 1e9\n" + std::string(constants));
    EXPECT_EQ(m.c1, 2e6);
    EXPECT_EQ(m.c2, 0.5e6);
    EXPECT_EQ(m.bulk, 1e9);
  }
  const auto ogden = material(
      "law = \"ogden\"\ndensity = 1100\nmu = [0.63e6, 1200, -1e4]\nalpha = [1.3, 5, -2]\nbulk = 1e9");
  EXPECT_EQ(ogden.mu, (std::vector{0.63e6, 1200.0, -1e4}));
  EXPECT_EQ(ogden.alpha, (std::vector{1.3, 5.0, -2.0}));
}

/// A case of particles alone, from the text of its two tables.
Case cloud_case(const std::string& geometry, const std::string& particles) {
  return read_text_case("[geometry]\n" + geometry + "\n[particles]\n" + particles + "\n");
}

TEST(Case, ShapesNeedNoFileAndNoScene) {
  const Case c = cloud_case("shape = \"tube\"\nouter_radius = 2\ninner_radius = 1.5\nheight = 3",
                            "arrangement = \"lattice\"\nspacing = 0.1\nlattice = \"hexagonal\"");
  ASSERT_TRUE(c.geometry.shape.has_value());
  EXPECT_EQ(c.geometry.shape->name, "tube");
  EXPECT_EQ(c.geometry.shape->lengths, (std::vector<std::vector<double>>{{2}, {1.5}, {3}}));
  EXPECT_EQ(c.geometry_text(), "tube 2 1.5 3 m");
  EXPECT_EQ(c.particles.lattice, preprocess::LatticeKind::hexagonal);
  EXPECT_FALSE(c.has_scene);
  EXPECT_THROW(c.require_scene(), InputError);
}

TEST(Case, PlaneShapesTakeTwoLengths) {
  const Case c = cloud_case("shape = \"rectangle\"\ndimension = 2\nsize = [3, 1]",
                            "arrangement = \"poisson\"\ncount = 500\nrelax = 10");
  EXPECT_EQ(c.geometry.dimension, 2);
  EXPECT_EQ(c.geometry.shape->lengths, (std::vector<std::vector<double>>{{3, 1}}));
  EXPECT_EQ(c.particles.arrangement, preprocess::Arrangement::poisson);
  EXPECT_EQ(c.particles.relax, 10);
}

TEST(Case, RefinementsOfIrregularClouds) {
  const Case c = cloud_case("shape = \"box\"\nsize = [1, 1, 1]",
                            "arrangement = \"voronoi\"\nspacing = 0.1\nrelax_seeds = 4\nbackend = \"voro\"\n"
                            "refine = [{around = \"x_min\", factor = 0.5, within = 0.1, until = 0.3},\n"
                            "{around = [1, 0, 0.5], factor = 0.25, until = 0.2}]");
  ASSERT_EQ(c.particles.refine.size(), 2U);
  EXPECT_EQ(std::get<std::string>(c.particles.refine[0].around), "x_min");
  EXPECT_EQ(c.particles.refine[0].within, 0.1);
  EXPECT_EQ(std::get<Vec3>(c.particles.refine[1].around), Vec3(1, 0, 0.5));
  EXPECT_EQ(c.particles.refine[1].factor, 0.25);
  EXPECT_EQ(c.particles.relax_seeds, 4);
  EXPECT_EQ(c.particles.backend, preprocess::Backend::voro);
}

TEST(Case, WhatAnArrangementHasNoUseForIsRefusedUnlessItAsksForNothing) {
  const auto message = [](const std::string& particles) -> std::string {
    try {
      cloud_case("shape = \"box\"\nsize = [1, 1, 1]", particles + "\nspacing = 0.1");
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("arrangement = \"lattice\"\nrelax = 3").find("relax does nothing to a lattice"),
            std::string::npos);
  EXPECT_NE(message("arrangement = \"lattice\"\nrefine = [{around = \"x_min\", factor = 0.5, until = 1}]"),
            "");
  EXPECT_NE(message("arrangement = \"voronoi\"\nlattice = \"hexagonal\""), "");
  EXPECT_NE(message("arrangement = \"poisson\"\nrelax_seeds = 1"), "");
  EXPECT_NE(message("arrangement = \"poisson\"\njitter = 0.1").find("jitter does nothing"),
            std::string::npos);
  EXPECT_EQ(message("arrangement = \"lattice\"\njitter = 0.3"), "");
  EXPECT_NE(message("arrangement = \"lattice\"\njitter = 0.5").find("from 0 to 0.45"), std::string::npos);
  EXPECT_EQ(message("arrangement = \"lattice\"\nrelax = 0\nseed = 7\nmerge = 0.4"), "");
  EXPECT_NE(message("arrangement = \"voronoi\"\nrefine = [{around = \"x_min\", factor = 2, until = 1}]")
                .find("above 1"),
            std::string::npos);
}

TEST(Case, SelectorsOfSets) {
  const Case c =
      read_text_case(complete_case + "[[set]]\nname = \"b\"\nbox = {lower = [0, 0, 0], upper = [1, 2, 3]}\n"
                                     "[[set]]\nname = \"n\"\nnearest = [1, 2, 3]\ntolerance = 0.5\n");
  ASSERT_EQ(c.particles.sets.size(), 3U);
  EXPECT_EQ(std::get<preprocess::BoxSelector>(c.particles.sets[1].where).upper, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<preprocess::NearestSelector>(c.particles.sets[2].where).point, Vec3(1, 2, 3));
  EXPECT_EQ(c.particles.sets[2].tolerance, 0.5);
}

TEST(Case, SpinIsAngularVelocityTimesArm) {
  const Case c = read_text_case(
      with("velocity = [0, \"10*Z/6\", -227]", "spin = {omega = [1, -2, 105], centre = [0.5, -0.25, 1e-3]}"));
  const Vec3 omega(1, -2, 105), centre(0.5, -0.25, 1e-3), X(0.3, 7, -1);
  const Vec3 expected = omega.cross(X - centre);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(c.scene.initial[0].velocity->at(static_cast<std::size_t>(i))(X), expected[i],
                1e-12 * expected.norm());
}

TEST(Case, FixedComponents) {
  const Case c = read_text_case(with("type = \"clamped\"", "type = \"fixed\"\ncomponents = [\"x\", \"z\"]"));
  EXPECT_EQ(c.scene.boundary[0].component, (std::array{true, false, true}));
}

TEST(Case, GeometryIsRelativeToTheCaseAndMadeAbsolute) {
  const CaseFolder folder;
  const Case c = read_case(folder.file("case.toml", complete_case), {});
  EXPECT_EQ(c.geometry.file, fs::weakly_canonical(folder.path() / "bar.step"));
  EXPECT_NE(c.text.find(c.geometry.file.string()), std::string::npos);
}

TEST(Case, GeometryTypedOnTheCommandLineIsRelativeToWhereItWasTyped) {
  const Case c = read_text_case(complete_case, {"geometry.file=typed.step"});
  EXPECT_EQ(c.geometry.file, fs::weakly_canonical(fs::current_path() / "typed.step"));
}

TEST(Case, StoredTextReadsBackAsTheSameCase) {
  const CaseFolder folder;
  const Case c =
      read_case(folder.file("case.toml", complete_case), {"particles.count=500", "solver.jst4=0.1"});
  const Case again = read_case(folder.file("stored.toml", c.text), {});
  EXPECT_EQ(again.text, c.text);
  EXPECT_EQ(again.particles.count, 500);
  EXPECT_EQ(again.scene.jst4->elastic, 0.1);
  EXPECT_EQ(again.geometry.file, c.geometry.file);
  EXPECT_EQ(again.scene.end_time, c.scene.end_time);
}

TEST(Case, RemembersWhereKeysWereWritten) {
  const CaseFolder folder;
  const fs::path file = folder.file("case.toml", complete_case);
  const Case c = read_case(file, {"particles.seed=2"});
  EXPECT_EQ(c.where("geometry.file"), file.string() + ":3:8");
  EXPECT_EQ(c.where("wall.0.plane"), file.string() + ":21:9");
  EXPECT_EQ(c.where("wall.0.restitution"), file.string() + ":20:1") << "absent: the table it belongs to";
  EXPECT_EQ(c.where("particles.seed"), "--set particles.seed=2");
}

TEST(Case, CloudTextIsWhatTheParticlesDependOn) {
  const CaseFolder folder;
  const fs::path file = folder.file("case.toml", complete_case);
  const std::string cloud = read_case(file, {}).cloud_text;
  EXPECT_EQ(read_case(file, {"solver.cfl=0.1", "material.young=1e9"}).cloud_text, cloud);
  EXPECT_NE(read_case(file, {"particles.seed=2"}).cloud_text, cloud);
  EXPECT_NE(read_case(file, {"set.0.tolerance=1e-5"}).cloud_text, cloud);
  EXPECT_NE(read_case(file, {"geometry.tolerance=1e-5"}).cloud_text, cloud);
}

TEST(Case, NamesItselfAfterFolderAndFile) {
  const CaseFolder folder;
  const std::string name = folder.path().filename().string();
  EXPECT_EQ(read_case(folder.file("case.toml", complete_case), {}).name, name);
  EXPECT_EQ(read_case(folder.path(), {}).name, name) << "a folder stands for its case.toml";
  EXPECT_EQ(read_case(folder.file("voronoi.toml", complete_case), {}).name, name + "-voronoi");
}

TEST(Case, ThoseOfTheProjectAreValid) {
  int cases = 0;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(fs::path(TESSERA_SOURCE_DIR) / "geometries"))
    if (entry.path().extension() == ".toml" && !entry.path().filename().string().starts_with("study")) {
      ++cases;
      EXPECT_NO_THROW(read_case(entry.path(), {})) << entry.path();
    }
  EXPECT_GE(cases, 4);
}

TEST(Case, ExactSolutionsMayGiveAnyOfTheirFields) {
  const auto exact = [](const std::string& keys) {
    return read_text_case(complete_case + "[exact]\n" + keys).scene.exact.value();
  };
  const solver::ExactSolution one = exact("displacement = [\"X*t\", 0, 2]\n");
  EXPECT_EQ(one.displacement->at(0)(Vec3(3, 0, 0), 2), 6);
  EXPECT_FALSE(one.velocity);
  EXPECT_FALSE(one.pressure);
  const solver::ExactSolution two = exact("velocity = [0, 1, 0]\npressure = \"Y\"\n");
  EXPECT_EQ(two.velocity->at(1)(Vec3::Zero()), 1);
  EXPECT_EQ((*two.pressure)(Vec3(0, 4, 0)), 4);
  EXPECT_FALSE(two.displacement);
  EXPECT_NE(message(complete_case + "[exact]\n").find("give displacement, velocity or pressure"),
            std::string::npos);
  EXPECT_NE(message(complete_case + "[exact]\npresure = 1\n").find("did you mean 'pressure'"),
            std::string::npos);
}

TEST(Overrides, WordsNeedNoQuotes) {
  const Case c = read_text_case(complete_case, {"particles.arrangement=voronoi", "title=two words",
                                                "set.0.name=\"q\"", "boundary.0.on=q"});
  EXPECT_EQ(c.particles.arrangement, preprocess::Arrangement::voronoi);
  EXPECT_EQ(c.title, "two words");
  EXPECT_EQ(c.particles.sets[0].name, "q");
}

TEST(Overrides, MakeTablesAndEntriesThatAreNotThere) {
  const Case c =
      read_text_case(complete_case, {"material.plasticity.yield=4e8", "material.plasticity.hardening=0",
                                     "initial.0.velocity=[1,2,\"X\"]", "wall.1.plane.point=[0,0,1]",
                                     "wall.1.plane.normal=[0,0,-1]"});
  EXPECT_EQ(std::get<solver::LinearHardening>(*c.scene.material.plasticity).yield, 4e8);
  EXPECT_EQ(c.scene.initial[0].velocity->at(2)(Vec3(5, 0, 0)), 5);
  ASSERT_EQ(c.scene.walls.size(), 2U);
  EXPECT_EQ(c.scene.walls[1].shape->gap({1, 2, 3}).normal, Vec3(0, 0, -1));
}

TEST(Overrides, LaterOnesWin) {
  EXPECT_EQ(read_text_case(complete_case, {"solver.cfl=0.1", "solver.cfl=0.2"}).scene.cfl, 0.2);
}

TEST(Overrides, CountReplacesTheFilesSpacing) {
  const Case c = read_text_case(complete_case, {"particles.count=500"});
  EXPECT_EQ(c.particles.count, 500);
  EXPECT_EQ(c.particles.spacing, 0);
  EXPECT_NE(
      message(complete_case, {"particles.count=500", "particles.spacing=0.1"}).find("both spacing and count"),
      std::string::npos);
}

} // namespace
} // namespace tessera::app
