#include "preprocess/voronoi/merge.hpp"
#include "tests/support/slabs.hpp"
#include "tests/support/tessellation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tessera::preprocess {
namespace {

using test::random_points;
using test::Tessellation;
using Loop = std::vector<Vec<2>>;

Loop kept(const Loop& loop, const Vec<2>& normal, const Vec<2>& point) {
  Loop result;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec<2>&a = loop[k], &b = loop[(k + 1) % loop.size()];
    const double s = normal.dot(a - point), t = normal.dot(b - point);
    if (s <= 0)
      result.push_back(a);
    if ((s <= 0) != (t <= 0))
      result.push_back(a + (b - a) * (s / (s - t)));
  }
  return result;
}

double area_of(const Loop& loop) {
  double twice = 0;
  for (std::size_t k = 2; k < loop.size(); ++k) {
    const Vec<2> p = loop[k - 1] - loop[0], q = loop[k] - loop[0];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

/// Area of a cell by cutting every triangle of the upper lid with every bisector, in the plane.
double area_by_hand(const Tessellation& t, std::size_t i) {
  double area = 0;
  for (const auto& facet : t.domain.facets) {
    if (facet.surface != Domain::lid || t.body.points[facet.vertices[0]].z() < 0)
      continue;
    Loop loop;
    for (const std::int32_t v : facet.vertices)
      loop.push_back(t.body.points[v].head<2>());
    for (std::size_t j = 0; j < t.seeds.size() && !loop.empty(); ++j)
      if (j != i)
        loop = kept(loop, (t.seeds[j] - t.seeds[i]).head<2>(), ((t.seeds[i] + t.seeds[j]) / 2).head<2>());
    area += area_of(loop);
  }
  return area;
}

TEST(PlaneCells, AgreeWithCuttingEveryTriangleByEveryBisectorInThePlane) {
  for (const Domain& domain : {test::l_slab(2), test::holed_slab(3), test::slotted_slab(3, 0.1)}) {
    const Tessellation t(domain, random_points(domain, 90));
    const CellMeasures measures = measure_cells(t.voronoi);
    ASSERT_TRUE(measures.orphans.empty() || domain.surfaces.size() > 6);
    std::vector<double> expected(t.seeds.size());
    for (std::size_t i = 0; i < t.seeds.size(); ++i)
      expected[i] = area_by_hand(t, i);
    std::vector<bool> handed(t.seeds.size(), false);
    for (const auto& orphan : measures.orphans)
      handed[orphan.cell] = handed[orphan.receiver] = true;
    for (std::size_t i = 0; i < t.seeds.size(); ++i)
      if (!handed[i]) {
        EXPECT_NEAR(measures.volume[i], expected[i], 1e-12) << i;
      }
  }
}

TEST(PlaneCells, FewSeedsAndSeedsInALineFillTheBody) {
  const Domain domain = test::l_slab(2);
  std::vector<Vec3> line;
  for (int i = 0; i < 7; ++i)
    line.emplace_back(0.1 + 0.25 * i, 0.5, 0);
  for (const auto& X : {random_points(domain, 1), random_points(domain, 2), random_points(domain, 3), line}) {
    const Tessellation t(domain, X);
    double sum = 0;
    for (const double v : measure_cells(t.voronoi).volume)
      sum += t.volume(v);
    EXPECT_NEAR(sum, 3, 1e-12);
  }
}

TEST(PlaneCells, OnlyCellsAtWallsAreCutByTetrahedra) {
  const Domain domain = test::l_slab(8);
  const Tessellation t(domain, random_points(domain, 2000));
  const CellMeasures measures = measure_cells(t.voronoi);
  int inside = 0;
  for (std::int64_t i = 0; i < t.voronoi.size(); ++i) {
    EXPECT_EQ(t.voronoi.meets_boundary(i), !measures.shares[i].empty()) << i;
    inside += !t.voronoi.meets_boundary(i);
  }
  EXPECT_GT(inside, 1500);
}

TEST(PlaneCells, MeasuresHaveNoZAndWallsOnly) {
  const Domain domain = test::holed_slab(4);
  const Tessellation t(domain, random_points(domain, 300));
  const CellMeasures measures = measure_cells(t.voronoi);
  for (std::size_t i = 0; i < t.seeds.size(); ++i) {
    EXPECT_EQ(measures.moment[i].z(), 0);
    for (const auto& share : measures.shares[i]) {
      EXPECT_GE(share.surface, 0);
      EXPECT_EQ(share.area.z(), 0);
    }
  }
}

TEST(PlaneVertices, AreWhereEulerCountsThem) {
  // Points on the rim and inside have three sides each: rim + inside = 2 (seeds + holes - 1) while every cell
  // hangs together and has no hole.
  for (const bool holed : {false, true}) {
    const Domain domain = holed ? test::holed_slab(4) : test::l_slab(3);
    const Tessellation t(domain, random_points(domain, 500));
    ASSERT_EQ(measure_cells(t.voronoi).disconnected, 0);
    const PlacedPoints points = cell_vertices(t.voronoi);
    std::array<std::int64_t, 4> by_dimension{};
    for (const auto& place : points.place)
      ++by_dimension[place.dimension];
    EXPECT_EQ(by_dimension[0], holed ? 4 : 6);
    EXPECT_EQ(by_dimension[1] + by_dimension[2], 2 * (500 + holed - 1));
    EXPECT_EQ(by_dimension[3], 0);
    EXPECT_GT(by_dimension[1], 50);
    EXPECT_EQ(merged(points, CadTopology(t.domain), 0).size(), points.size()) << "none is found twice";
  }
}

TEST(PlaneVertices, AreEquallyFarFromTheirSeedsAndLieOnTheirWalls) {
  const Domain domain = test::holed_slab(4);
  const Tessellation t(domain, random_points(domain, 400));
  const PlacedPoints points = cell_vertices(t.voronoi);
  std::uint8_t last = 0;
  for (std::int64_t k = 0; k < points.size(); ++k) {
    const auto& place = points.place[k];
    EXPECT_GE(place.dimension, last);
    last = place.dimension;
    EXPECT_EQ(points.X[k].z(), 0);
    std::vector<double> distances;
    for (const Vec3& seed : t.seeds)
      distances.push_back((seed - points.X[k]).norm());
    std::sort(distances.begin(), distances.end());
    EXPECT_LE(distances[place.dimension] - distances[0], 1e-12) << k;
    if (place.dimension == 2) {
      EXPECT_EQ(place.entity, -1);
    }
    if (place.dimension != 1)
      continue;
    double off = 1;
    for (const auto& edge : domain.feature_edges) {
      if (edge.curve != place.entity)
        continue;
      const Vec<2> a = t.body.points[edge.vertices[0]].head<2>(),
                   along = (t.body.points[edge.vertices[1]].head<2>() - a).normalized(),
                   to = points.X[k].head<2>() - a;
      off = std::min(off, std::abs(along[0] * to[1] - along[1] * to[0]));
    }
    EXPECT_LE(off, 1e-13);
  }
}

TEST(PlaneCells, AreFlatPolygonsToLookAt) {
  const Domain domain = test::l_slab(3, 1e-2);
  const Tessellation t(domain, random_points(domain, 200));
  const CellMeasures measures = measure_cells(t.voronoi);
  const CellMesh mesh = collect_cells(t.voronoi, measures);
  std::vector<double> area(t.seeds.size(), 0);
  for (const auto& cell : mesh.cells) {
    ASSERT_EQ(cell.faces.size(), 1u);
    Loop loop;
    for (const std::int32_t v : cell.faces[0]) {
      EXPECT_EQ(mesh.points[v].z(), 0);
      loop.push_back(mesh.points[v].head<2>());
    }
    EXPECT_GE(area_of(loop), 0);
    area[cell.particle] += area_of(loop);
  }
  for (std::size_t i = 0; i < area.size(); ++i)
    EXPECT_NEAR(area[i], t.volume(measures.volume[i]), 1e-12 * domain.volume);
}

TEST(PlaneTopology, CurvesLieOnTheirWallAndCornersOnTwo) {
  const Domain domain = test::l_slab(2);
  const CadTopology cad(domain);
  ASSERT_EQ(domain.surfaces.size(), 6u);
  ASSERT_EQ(domain.corners.size(), 6u);
  for (std::int32_t wall = 0; wall < 6; ++wall)
    EXPECT_EQ(cad.surfaces_of({1, wall}), std::vector<std::int32_t>{wall});
  for (const std::int32_t corner : domain.corners) {
    const auto& walls = cad.surfaces_of({0, corner});
    ASSERT_EQ(walls.size(), 2u);
    EXPECT_TRUE(cad.on_curve({0, corner}, walls[0]));
    EXPECT_TRUE(cad.curves_share_a_corner(walls[0], walls[1]));
    EXPECT_TRUE(cad.surfaces_share_a_curve(walls[0], walls[1]));
  }
  EXPECT_TRUE(cad.surfaces_of({2, -1}).empty());
}

TEST(PlaneTopology, WallsDoNotRunOntoLidsOrOtherWalls) {
  const Domain domain = test::square_slab(2);
  const CadTopology cad(domain);
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(domain.facets.size()); ++f)
    for (const std::int32_t g : cad.smooth_across(f))
      if (g >= 0) {
        EXPECT_EQ(domain.facets[f].surface, domain.facets[g].surface);
      }
}

} // namespace
} // namespace tessera::preprocess
