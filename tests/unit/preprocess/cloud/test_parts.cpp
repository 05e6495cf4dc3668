// The parts the scenes use, from their CAD files.
#include "preprocess/cloud/prepare.hpp"
#include "preprocess/geometry/import.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tessera::preprocess {
namespace {

Domain part(const char* file) {
  GeometrySource source;
  source.file = std::string(TESSERA_SOURCE_DIR) + "/geometries/" + file;
  source.unit = "mm";
  return import_geometry(source, Progress::silent());
}

std::int64_t corners_in(const ParticleCloud& cloud) {
  return std::count(cloud.cad_dimension.begin(), cloud.cad_dimension.end(), 0);
}

/// Also that all groups of surfaces have their areas, within a share of the body's size squared.
void expect_exact(const Domain& domain, const Prepared& p, double area_error = 1e-12) {
  EXPECT_LE(p.quality.volume_error, 1e-12);
  EXPECT_LE(p.quality.closure_error, 1e-12);
  EXPECT_LE(p.quality.first_moment_error, 1e-12);
  Vec3 sum = Vec3::Zero(), facets = Vec3::Zero();
  for (const auto& group : domain.groups) {
    if (group.dimension != 2)
      continue;
    sum.setZero();
    facets.setZero();
    for (const auto& f : domain.facets)
      if (std::find(group.surfaces.begin(), group.surfaces.end(), f.surface) != group.surfaces.end()) {
        const Vec3& a = domain.vertices[f.vertices[0]];
        facets += 0.5 * (domain.vertices[f.vertices[1]] - a).cross(domain.vertices[f.vertices[2]] - a);
      }
    for (const Vec3& A : p.cloud.set(group.name).area)
      sum += A;
    EXPECT_LE((sum - facets).norm(), area_error * (domain.upper - domain.lower).squaredNorm()) << group.name;
  }
}

TEST(TaylorBar, LatticeHas81ColumnsOf51) {
  const Domain bar = part("taylor_bar/taylor_bar.step");
  ParticleRequest request;
  request.spacing = 0.64e-3;
  const Prepared p = prepare(bar, request, Progress::silent());
  EXPECT_EQ(p.cloud.size(), 81 * 51);
  expect_exact(bar, p, 0.01); // lattices lie beside curved and oblique surfaces
}

TEST(TaylorBar, TwoPassCloud) {
  const Domain bar = part("taylor_bar/taylor_bar.step");
  ParticleRequest request;
  request.arrangement = Arrangement::voronoi;
  request.count = 4000;
  const Prepared p = prepare(bar, request, Progress::silent());
  EXPECT_NEAR(static_cast<double>(p.cloud.size()), 4000, 80);
  EXPECT_GE(p.quality.spacing_min_over_h, 0.39);
  EXPECT_EQ(corners_in(p.cloud), static_cast<std::int64_t>(bar.corners.size()));
  expect_exact(bar, p);
}

TEST(Bracket, BothArrangementsAreExactOnANonConvexPart) {
  const Domain bracket = part("bracket/bracket.step");
  ParticleRequest request;
  request.count = 3000;
  expect_exact(bracket, prepare(bracket, request, Progress::silent()), 0.01);
  request.arrangement = Arrangement::voronoi;
  const Prepared p = prepare(bracket, request, Progress::silent());
  expect_exact(bracket, p);
  EXPECT_NEAR(static_cast<double>(p.cloud.size()), 3000, 60);
  EXPECT_EQ(corners_in(p.cloud), static_cast<std::int64_t>(bracket.corners.size()));
  EXPECT_GE(p.quality.spacing_min_over_h, 0.39);
}

} // namespace
} // namespace tessera::preprocess
