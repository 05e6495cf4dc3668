#include "postprocess/cell_surfaces.hpp"
#include "postprocess/cloud_picture.hpp"
#include "postprocess/picture.hpp"
#include "postprocess/report.hpp"
#include "tests/unit/postprocess/seen.hpp"
#include "tests/unit/postprocess/stored_run.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numeric>
#include <sstream>

namespace tessera::post {
namespace {

using test::Seen;
using test::TemporaryFolder;

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The box [0, 1] x [0, 1] x [0, 1] moved and stretched, its faces outwards.
CellMesh::Cell box_cell(CellMesh& mesh, std::int32_t particle, const Vec3& lower, const Vec3& upper) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (int c = 0; c < 8; ++c)
    mesh.points.emplace_back(c & 1 ? upper.x() : lower.x(), c & 2 ? upper.y() : lower.y(),
                             c & 4 ? upper.z() : lower.z());
  CellMesh::Cell cell{particle,
                      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (auto& loop : cell.faces)
    for (std::int32_t& p : loop)
      p += first;
  return cell;
}

/// n x n x 2 particles in the middles of cubes of side 1 mm.
struct Cubes {
  ParticleCloud cloud;
  CellMesh cells;

  explicit Cubes(int n) {
    cloud.spacing = 1e-3;
    cloud.arrangement = "lattice";
    cloud.subvolumes = "voronoi";
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Vec3 lower = 1e-3 * Vec3(i, j, k), upper = lower + Vec3::Constant(1e-3);
          cells.cells.push_back(box_cell(cells, static_cast<std::int32_t>(cloud.size()), lower, upper));
          cloud.X.push_back((lower + upper) / 2);
          cloud.V.push_back(1e-9 * (1 + 0.5 * (i % 2)));
          cloud.A.push_back(Vec3::Zero());
          cloud.cad_dimension.push_back(3);
        }
    cloud.centroid = cloud.X;
    cloud.domain_volume = std::accumulate(cloud.V.begin(), cloud.V.end(), 0.0);
  }
};

TEST(CellSurfaces, PiecesOfOneCellAreJoined) {
  // One cell in two pieces whose shared corners differ by rounding, and a cell of its own beside them.
  CellMesh mesh;
  mesh.cells.push_back(box_cell(mesh, 0, {0, 0, 0}, {0.5, 1, 1}));
  mesh.cells.push_back(box_cell(mesh, 1, {1, 0, 0}, {2, 1, 1}));
  mesh.cells.push_back(box_cell(mesh, 0, {0.5 + 1e-12, 0, 0}, {1, 1, 1}));
  const CellSurfaces both = cell_surfaces(mesh, {true, true}, 1e-9);
  EXPECT_EQ(both.faces.size(), 10u + 6u) << "without the cut inside the first";
  EXPECT_EQ(both.points.size(), 12u + 8u);
  // The two halves of each long edge stay two; the cut's own four edges are no edges of the cell.
  EXPECT_EQ(both.edges.size(), 16u + 12u);
  const CellSurfaces one = cell_surfaces(mesh, {false, true}, 1e-9);
  EXPECT_EQ(one.faces.size(), 6u);
  EXPECT_EQ(one.edges.size(), 12u);
  for (const CellSurfaces::Face& face : one.faces)
    EXPECT_EQ(face.particle, 1);
}

TEST(CellSurfaces, PlaneCellsHaveRims) {
  CellMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.cells = {{0, {{0, 1, 2}}}, {0, {{3, 4, 5}}}};
  const CellSurfaces square = cell_surfaces(mesh, {true}, 1e-9);
  EXPECT_EQ(square.faces.size(), 2u);
  EXPECT_EQ(square.edges.size(), 4u) << "not the diagonal between its two pieces";
}

TEST(Histogram, ClassesLieAboutMultiplesOfTheWidth) {
  const Histogram classes = histogram({0.0, 0.99999999, 1.00000001, 1.0, 0.5, 2.0});
  EXPECT_DOUBLE_EQ(classes.width, 0.05);
  ASSERT_EQ(classes.counts.size(), 41u);
  EXPECT_EQ(classes.counts[0], 1);
  EXPECT_EQ(classes.counts[10], 1);
  EXPECT_EQ(classes.counts[20], 3) << "rounding does not split a lattice's spacing";
  EXPECT_EQ(classes.counts[40], 1);
  EXPECT_EQ(std::accumulate(classes.counts.begin(), classes.counts.end(), std::int64_t{0}), 6);
  EXPECT_EQ(histogram({}).counts, std::vector<std::int64_t>{0});
}

TEST(Evenness, OfALatticeAndOfOneParticle) {
  const Cubes cubes(4);
  const Evenness even = evenness(cubes.cloud);
  for (const double distance : even.distance)
    EXPECT_NEAR(distance, 1, 1e-12);
  EXPECT_NEAR(even.volume[0], 0.8, 1e-12);
  EXPECT_NEAR(even.volume[1], 1.2, 1e-12);
  const std::vector<Table> tables = evenness_tables(even);
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[0].rows[1][0], "Subvolume / mean");
  EXPECT_EQ(tables[0].rows[1][1], "0.800");
  EXPECT_EQ(tables[1].rows, (std::vector<std::vector<std::string>>{{"0.99 to 1.01", "32", "100.00 %"}}));
  ParticleCloud one = cubes.cloud;
  for (auto* array : {&one.X, &one.A, &one.centroid})
    array->resize(1);
  one.V.resize(1);
  EXPECT_TRUE(evenness(one).distance.empty()) << "it has no neighbour to look for";
  EXPECT_EQ(evenness(one).volume, std::vector<double>{1});
}

TEST(CloudPicture, ShowsGivenCellsWithoutStoringThem) {
  const TemporaryFolder folder;
  const Cubes cubes(6);
  io::write_cloud(cubes.cloud, folder / "cloud.vtp");
  std::ostringstream out;
  Progress notes(out, false, false);
  ASSERT_EQ(draw_cloud(folder.path(), notes), std::vector<std::filesystem::path>{folder / "cloud.png"});
  const Seen particles(folder / "cloud.png");
  ASSERT_EQ(draw_cloud(folder.path(), notes, &cubes.cells).size(), 1u);
  const Seen cells(folder / "cloud.png");
  EXPECT_EQ(out.str(), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "cells.vtu"));
  EXPECT_GT(cells.largest_patch, 2 * particles.largest_patch) << "faces are flat, spheres are shaded";
  io::write_cells(cubes.cells, cubes.cloud, folder / "cells.vtu");
  ASSERT_EQ(draw_cloud(folder.path(), notes).size(), 1u);
  EXPECT_EQ(Seen(folder / "cloud.png").colours, cells.colours) << "stored cells look like given ones";
}

TEST(CloudPicture, APlaneCloudIsOnePanelOfPolygons) {
  const TemporaryFolder folder;
  ParticleCloud cloud;
  CellMesh cells;
  cloud.dimension = 2;
  cloud.spacing = 1e-3;
  cloud.domain_volume = 128e-6;
  cloud.arrangement = "lattice";
  cloud.subvolumes = "voronoi";
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 16; ++i) {
      const double x = 1e-3 * i, y = 1e-3 * j, d = 0.5e-3;
      const auto first = static_cast<std::int32_t>(cells.points.size());
      for (const Vec3& p :
           {Vec3(x - d, y - d, 0), Vec3(x + d, y - d, 0), Vec3(x + d, y + d, 0), Vec3(x - d, y + d, 0)})
        cells.points.push_back(p);
      cells.cells.push_back(
          {static_cast<std::int32_t>(cloud.size()), {{first, first + 1, first + 2, first + 3}}});
      cloud.X.emplace_back(x, y, 0);
      cloud.V.push_back(1e-6);
      cloud.A.push_back(Vec3::Zero());
      cloud.cad_dimension.push_back(2);
    }
  cloud.centroid = cloud.X;
  io::write_cloud(cloud, folder / "cloud.vtp");
  test::store(folder / "quality.json",
              R"({"particles": 128, "dimension": 2, "domain_volume": 1.28e-4, "cad_volume": 1.28e-4,
 "volume_sum": 1.28e-4, "sets": {"rim": 44}})");
  std::ostringstream out;
  Progress notes(out, false, false);
  const auto files = write_cloud_report(folder.path(), notes, "Plate", &cells);
  EXPECT_EQ(out.str(), "");
  EXPECT_EQ(files, (std::vector<std::filesystem::path>{folder / "cloud.png", folder / "cloud_histograms.png",
                                                       folder / "report.md", folder / "report.html"}));
  const Seen seen(folder / "cloud.png");
  EXPECT_GT(seen.width, seen.height) << "16 x 8 mm, seen from above, once";
  const std::string text = content(folder / "report.md");
  for (const char* line :
       {"# Plate\n", "![cloud](cloud.png)", "![cloud_histograms](cloud_histograms.png)",
        "| Nominal spacing h | 1 mm |", "| Area of the CAD body | 128 mm² |", "volumes are areas",
        "| Tessellated body against the CAD body, relative | 0 |", "| Particles in set 'rim' | 44 |"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " is not in\n" << text;
}

TEST(CloudPicture, DamagedFilesAreNoted) {
  const TemporaryFolder folder;
  const Cubes cubes(3);
  io::write_cloud(cubes.cloud, folder / "cloud.vtp");
  test::store(folder / "cells.vtu", "<VTKFile>");
  std::ostringstream out;
  Progress notes(out, false, false);
  EXPECT_TRUE(draw_cloud(folder.path(), notes).empty());
  EXPECT_NE(out.str().find("cells.vtu"), std::string::npos) << out.str();
  test::store(folder / "cloud.vtp", "<VTKFile>");
  EXPECT_TRUE(draw_cloud(folder.path(), notes).empty());
  EXPECT_NE(out.str().find("no cloud.png"), std::string::npos) << out.str();
  test::store(folder / "quality.json", R"({"particles": 18})");
  EXPECT_EQ(write_cloud_report(folder.path(), notes).size(), 2u) << "the figures remain";
}

} // namespace
} // namespace tessera::post
