#include "preprocess/cloud/prepare.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tessera::preprocess {
namespace {

ParticleRequest lattice(double spacing) {
  ParticleRequest request;
  request.arrangement = Arrangement::lattice;
  request.spacing = spacing;
  return request;
}

ParticleRequest voronoi(std::int64_t count) {
  ParticleRequest request;
  request.arrangement = Arrangement::voronoi;
  request.count = count;
  return request;
}

/// Outward area vector of each CAD surface.
std::vector<Vec3> surface_areas(const Domain& domain) {
  std::vector<Vec3> areas(domain.surfaces.size(), Vec3::Zero());
  for (const auto& facet : domain.facets) {
    const Vec3& a = domain.vertices[facet.vertices[0]];
    areas[facet.surface] +=
        0.5 * (domain.vertices[facet.vertices[1]] - a).cross(domain.vertices[facet.vertices[2]] - a);
  }
  return areas;
}

/// Also that all surfaces, flat ones, have their areas: exactly, or as far as a lattice beside them allows.
void expect_exact(const Domain& domain, const Prepared& prepared, double area_error = 1e-12) {
  const Quality& q = prepared.quality;
  EXPECT_LE(q.volume_error, 1e-12);
  EXPECT_LE(q.closure_error, 1e-12);
  EXPECT_LE(q.first_moment_error, 1e-12);
  EXPECT_LE(q.area_sum, 1e-12);
  EXPECT_LE(q.area_imbalance, 1e-13);
  EXPECT_EQ(q.disconnected_cells, 0);
  const auto areas = surface_areas(domain);
  for (std::size_t s = 0; s < areas.size(); ++s) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& A : prepared.cloud.set(domain.surfaces[s]).area)
      sum += A;
    EXPECT_LE((sum - areas[s]).norm(), area_error * areas[s].norm()) << domain.surfaces[s];
    EXPECT_LE(sum.cross(areas[s]).norm(), 1e-12 * areas[s].squaredNorm()) << domain.surfaces[s];
  }
}

std::int64_t corners_in(const ParticleCloud& cloud) {
  return std::count(cloud.cad_dimension.begin(), cloud.cad_dimension.end(), 0);
}

class AtScale : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Metres, AtScale, testing::Values(1e-6, 1.0, 1e3));

TEST_P(AtScale, BoxAndLShapeAreTessellatedExactly) {
  const double scale = GetParam();
  const Domain box = test::box_domain(Vec3(0.3, -2, 1) * scale, Vec3(1.7, -1, 1.9) * scale, 3);
  const Domain ell = test::l_domain(2, scale, Vec3(0.1, 0.2, 0.3) * scale);
  for (const Domain& domain : {box, ell}) {
    expect_exact(domain, prepare(domain, lattice(0.1 * scale), Progress::silent()));
    expect_exact(domain, prepare(domain, lattice(0.137 * scale), Progress::silent()), 0.1);
    expect_exact(domain, prepare(domain, voronoi(1500), Progress::silent()));
  }
}

TEST(Prepare, APlaneOnAFaceSelectsItsOwnersWhereTheLatticePassesBy) {
  ParticleRequest request = lattice(0.3); // 0.05 off every face
  request.sets = {{"face", PlaneSelector{Vec3::Zero(), Vec3::UnitX()}},
                  {"middle", PlaneSelector{Vec3(0.35, 0, 0), Vec3::UnitX()}}};
  const ParticleCloud cloud = prepare(test::box_domain(), request, Progress::silent()).cloud;
  EXPECT_EQ(cloud.size(), 64);
  EXPECT_EQ(cloud.set("face").particles, cloud.set("xmin").particles);
  EXPECT_EQ(cloud.set("face").particles.size(), 16u);
  EXPECT_EQ(cloud.set("middle").particles.size(), 16u);
  Vec3 area = Vec3::Zero();
  for (const Vec3& A : cloud.set("face").area)
    area += A;
  // The area of 1 is larger by what X (x) A, 0.05 short on either side, lacks of the volume.
  EXPECT_LE((area - Vec3(-1 / 0.9, 0, 0)).norm(), 1e-14);
}

TEST(Prepare, LatticeOfTheCubeHasItsPointsOnAllFaces) {
  const Domain box = test::box_domain();
  const Prepared p = prepare(box, lattice(0.125), Progress::silent());
  EXPECT_EQ(p.cloud.size(), 729);
  EXPECT_EQ(p.cloud.set("xmin").particles.size(), 81u);
  EXPECT_EQ(corners_in(p.cloud), 8);
  EXPECT_EQ(std::count(p.cloud.cad_dimension.begin(), p.cloud.cad_dimension.end(), 1), 12 * 7);
  EXPECT_EQ(std::count(p.cloud.cad_dimension.begin(), p.cloud.cad_dimension.end(), 2), 6 * 49);
  for (std::int64_t i = 0; i < p.cloud.size(); ++i) {
    // Half a spacing less on each side that lies on a face.
    double expected = std::pow(0.125, 3);
    for (int a = 0; a < 3; ++a)
      if (p.cloud.X[i][a] == 0 || p.cloud.X[i][a] == 1)
        expected /= 2;
    EXPECT_NEAR(p.cloud.V[i], expected, 1e-16);
  }
}

TEST(Prepare, JitterMovesInnerParticlesOfALatticeAndCutsTheirCells) {
  ParticleRequest request;
  request.spacing = 0.25;
  const ParticleCloud regular = prepare(test::l_domain(), request, Progress::silent()).cloud;
  request.jitter = 0.3;
  const Prepared moved = prepare(test::l_domain(), request, Progress::silent());
  const ParticleCloud& cloud = moved.cloud;
  EXPECT_EQ(cloud.arrangement, "jittered");
  EXPECT_LT(moved.quality.volume_error, 1e-12);
  ASSERT_EQ(cloud.size(), regular.size());
  const auto has = [&](const Vec3& X, std::uint8_t dimension, double reach) {
    for (std::int64_t b = 0; b < regular.size(); ++b)
      if (regular.cad_dimension[b] == dimension && (regular.X[b] - X).cwiseAbs().maxCoeff() <= reach)
        return true;
    return false;
  };
  std::int64_t far = 0;
  for (std::int64_t a = 0; a < cloud.size(); ++a) {
    const bool inner = cloud.cad_dimension[a] == 3;
    EXPECT_TRUE(has(cloud.X[a], cloud.cad_dimension[a], inner ? 0.3 * 0.25 : 0)) << a;
    far += inner && !has(cloud.X[a], 3, 0.15 * 0.25);
  }
  EXPECT_GT(far, 0);
}

TEST(Prepare, UniformSubvolumesKeepTheBoundaryAreasOfTheCells) {
  const Domain box = test::box_domain();
  ParticleRequest request = lattice(0.125);
  const Prepared exact = prepare(box, request, Progress::silent());
  request.subvolumes = Subvolumes::uniform;
  const Prepared uniform = prepare(box, request, Progress::silent());
  for (const double V : uniform.cloud.V)
    EXPECT_DOUBLE_EQ(V, 1.0 / 729);
  EXPECT_EQ(uniform.cloud.A, exact.cloud.A);
  EXPECT_EQ(uniform.cloud.subvolumes, "uniform");
}

TEST(Prepare, TwoPassCloudKeepsCornersDistanceAndCount) {
  for (const Domain& domain : {test::box_domain(), test::l_domain(2)})
    for (const std::int64_t count : {400, 3000}) {
      const Prepared p = prepare(domain, voronoi(count), Progress::silent());
      EXPECT_NEAR(static_cast<double>(p.cloud.size()), static_cast<double>(count), 0.02 * count);
      EXPECT_GE(p.quality.spacing_min_over_h, 0.39);
      EXPECT_EQ(corners_in(p.cloud), static_cast<std::int64_t>(domain.corners.size()));
      for (const std::int32_t v : domain.corners)
        EXPECT_EQ(std::count(p.cloud.X.begin(), p.cloud.X.end(), domain.vertices[v]), 1);
    }
}

TEST(Prepare, SameSeedSameBitsOnAnyThreadCount) {
  const Domain ell = test::l_domain(2);
  const auto cloud_with = [&](int threads, std::uint64_t seed) {
    set_threads(threads);
    ParticleRequest request = voronoi(2000);
    request.seed = seed;
    Prepared p = prepare(ell, request, Progress::silent());
    set_threads(0);
    return p;
  };
  const Prepared one = cloud_with(1, 5);
  for (const int threads : {2, 3}) {
    const Prepared many = cloud_with(threads, 5);
    EXPECT_EQ(one.cloud.X, many.cloud.X);
    EXPECT_EQ(one.cloud.V, many.cloud.V);
    EXPECT_EQ(one.cloud.A, many.cloud.A);
    EXPECT_EQ(one.cloud.centroid, many.cloud.centroid);
  }
  EXPECT_NE(one.cloud.X, cloud_with(1, 6).cloud.X);
}

TEST(Prepare, KeptCellsFillTheBody) {
  const Domain ell = test::l_domain(1);
  ParticleRequest request = voronoi(300);
  request.keep_cells = true;
  const Prepared p = prepare(ell, request, Progress::silent());
  std::vector<double> volume(p.cloud.X.size(), 0);
  for (const auto& cell : p.cells.cells)
    for (const auto& face : cell.faces)
      for (std::size_t k = 2; k < face.size(); ++k)
        volume[cell.particle] +=
            p.cells.points[face[0]].dot(p.cells.points[face[k - 1]].cross(p.cells.points[face[k]])) / 6;
  for (std::size_t i = 0; i < volume.size(); ++i)
    EXPECT_NEAR(volume[i], p.cloud.V[i], 1e-13);
}

TEST(Prepare, SelectorsFindTheirParticlesOrSayWhereTheyAre) {
  const Domain box = test::box_domain();
  ParticleRequest request = lattice(0.25);
  request.sets = {{"middle", PlaneSelector{Vec3(0.5, 0, 0), Vec3(2, 0, 0)}},
                  {"top", PlaneSelector{Vec3(0, 0, 1), Vec3(0, 0, 1)}},
                  {"octant", BoxSelector{Vec3::Zero(), Vec3::Constant(0.25)}},
                  {"probe", NearestSelector{Vec3(0.51, 0.2, 0.9)}}};
  const Prepared p = prepare(box, request, Progress::silent());
  EXPECT_EQ(p.cloud.set("middle").particles.size(), 25u);
  EXPECT_TRUE(p.cloud.set("middle").area.empty());
  EXPECT_EQ(p.cloud.set("top").particles, p.cloud.set("zmax").particles);
  EXPECT_EQ(p.cloud.set("top").area, p.cloud.set("zmax").area);
  EXPECT_EQ(p.cloud.set("octant").particles.size(), 8u);
  ASSERT_EQ(p.cloud.set("probe").particles.size(), 1u);
  EXPECT_EQ(p.cloud.X[p.cloud.set("probe").particles[0]], Vec3(0.5, 0.25, 1));

  request.sets = {{"nowhere", BoxSelector{Vec3::Constant(3), Vec3::Constant(4)}}};
  try {
    prepare(box, request, Progress::silent());
    FAIL() << "an empty set went unnoticed";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("(1, 1, 1)"), std::string::npos);
  }
}

TEST(Prepare, GroupsOfOneNameAndReservedNamesGetNamesOfTheirOwn) {
  Domain box = test::box_domain();
  box.groups = {{"edge", 1, {}, {0}, {}}, {"edge", 2, {0}, {}, {}}, {"all", 2, {1}, {}, {}}};
  const ParticleCloud cloud = prepare(box, lattice(0.25), Progress::silent()).cloud;
  EXPECT_EQ(cloud.set("edge").particles.size(), 5u);
  EXPECT_EQ(cloud.set("edge.surfaces").particles.size(), 25u);
  EXPECT_EQ(cloud.set("all.surfaces").particles.size(), 25u);
}

TEST(Prepare, PointsFarFromTheBodyAreTakenForSlipsOfUnits) {
  const Domain box = test::box_domain();
  ParticleRequest far = lattice(0.25);
  far.sets = {{"probe", NearestSelector{Vec3(50, 0, 0)}}};
  EXPECT_THROW(prepare(box, far, Progress::silent()), InputError);
  ParticleRequest refined = voronoi(500);
  refined.refine = {{Vec3(50, 0, 0), 0.5, 0, 10}};
  EXPECT_THROW(prepare(box, refined, Progress::silent()), InputError);
  refined.refine = {{Vec3(1.2, 0, 0), 0.5, 0, 0.5}};
  EXPECT_NO_THROW(prepare(box, refined, Progress::silent()));
}

/// What prepare() says while it works.
std::string notes_of(const Domain& domain, const ParticleRequest& request) {
  std::ostringstream out;
  Progress progress(out, false, false);
  prepare(domain, request, progress);
  return out.str();
}

TEST(Prepare, PartsFinerThanTheLatticeAreSpokenOf) {
  // Three points a side, a tenth of it off the faces: X (x) A sums to 0.8 of the volume.
  EXPECT_NE(notes_of(test::box_domain(), lattice(0.4)).find("25 % of its areas"), std::string::npos);
  EXPECT_EQ(notes_of(test::box_domain(), lattice(0.25)).find("note:"), std::string::npos);
}

TEST(Prepare, RefusesRequestsItCannotMeet) {
  const Domain box = test::box_domain();
  const auto refuses = [&](const ParticleRequest& request) {
    EXPECT_THROW(prepare(box, request, Progress::silent()), InputError);
  };
  refuses(ParticleRequest{}); // neither spacing nor count
  ParticleRequest both = lattice(0.1);
  both.count = 10;
  refuses(both);
  refuses(lattice(std::nan("")));
  refuses(lattice(1e-4)); // a million million particles
  refuses(lattice(5));    // one particle in the middle
  ParticleRequest far = voronoi(0);
  far.spacing = 10;
  refuses(far);
  ParticleRequest merge = voronoi(100);
  merge.merge = 1;
  refuses(merge);
  ParticleRequest twice = lattice(0.5);
  twice.sets = {{"xmin", NearestSelector{Vec3::Zero()}}};
  refuses(twice);
}

TEST(Prepare, QualityIsWrittenAsJson) {
  const Prepared p = prepare(test::box_domain(), lattice(0.5), Progress::silent());
  const std::string text = to_json(p.quality);
  for (const char* key :
       {"\"particles\": 27", "\"volume_error\"", "\"disconnected_cells\": 0", "\"xmin\": 9"})
    EXPECT_NE(text.find(key), std::string::npos) << key;
}

} // namespace
} // namespace tessera::preprocess
