#include "preprocess/geometry/rigid_surface.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace tessera;
using namespace tessera::preprocess;

namespace {

/// Points of a grid around [lower, upper] that hits faces, edges, corners and the regions beyond each.
std::vector<Vec3> around(const Vec3& lower, const Vec3& upper, int n) {
  std::vector<Vec3> points;
  const Vec3 margin = 0.5 * (upper - lower);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k)
        points.push_back(lower - margin +
                         2 * (upper - lower).cwiseProduct(Vec3(i, j, k) / static_cast<double>(n)));
  return points;
}

/// Exact signed distance to a box.
double box_distance(const Vec3& x, const Vec3& lower, const Vec3& upper) {
  const Vec3 out = (lower - x).cwiseMax(x - upper);
  return out.cwiseMax(0).norm() + std::min(out.maxCoeff(), 0.0);
}

/// The nearest of many points on each facet, no nearer than the truth.
double sampled_distance(const Domain& domain, const Vec3& x, int n) {
  double nearest = INFINITY;
  for (const Domain::Facet& f : domain.facets) {
    const Vec3 &a = domain.vertices[f.vertices[0]], &b = domain.vertices[f.vertices[1]],
               &c = domain.vertices[f.vertices[2]];
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        nearest = std::min(nearest, (a + (b - a) * i / n + (c - a) * j / n - x).norm());
  }
  return nearest;
}

/// A unit normal that leads from x back onto the surface.
void expect_normal(const RigidSurface& surface, const Vec3& x) {
  const RigidShape::Gap gap = surface.gap(x);
  EXPECT_NEAR(gap.normal.norm(), 1, 1e-12);
  EXPECT_NEAR(surface.gap(x - gap.distance * gap.normal).distance, 0, 1e-12) << x.transpose();
  EXPECT_NEAR(surface.gap(x - 0.5 * gap.distance * gap.normal).distance, 0.5 * gap.distance, 1e-12);
}

Domain facets_only(const std::vector<Vec3>& vertices,
                   const std::vector<std::array<std::int32_t, 3>>& facets) {
  Domain domain;
  domain.vertices = vertices;
  for (const auto& f : facets)
    domain.facets.push_back({f, 0, 0});
  return domain;
}

} // namespace

TEST(RigidSurface, ACubeIsExactOnFacesEdgesCornersAndBeyond) {
  const Vec3 lower(0.1, -0.2, 0.3), upper(1.1, 0.8, 1.3);
  const RigidSurface cube(test::box_domain(lower, upper, 3));
  for (const Vec3& x : around(lower, upper, 16)) {
    EXPECT_NEAR(cube.gap(x).distance, box_distance(x, lower, upper), 1e-14) << x.transpose();
    expect_normal(cube, x);
  }
  EXPECT_LT((cube.gap(lower - Vec3(1, 2, 2)).normal - Vec3(-1, -2, -2) / 3).norm(), 1e-14);
  EXPECT_LT((cube.gap({0.6, 0.7, 0.8}).normal - Vec3(0, 1, 0)).norm(), 1e-14);
  // On an edge and on a corner itself: the mean of the faces'.
  EXPECT_LT((cube.gap({1.1, 0.8, 0.85}).normal - Vec3(1, 1, 0).normalized()).norm(), 1e-14);
  EXPECT_LT((cube.gap(upper).normal - Vec3(1, 1, 1).normalized()).norm(), 1e-14);
}

TEST(RigidSurface, AReentrantCornerHasItsSides) {
  const RigidSurface part(test::l_domain(2));
  for (const Vec3& x : around({0, 0, 0}, {2, 2, 1}, 16)) {
    const double outside =
        std::min(box_distance(x, {0, 0, 0}, {2, 1, 1}), box_distance(x, {0, 0, 0}, {1, 2, 1}));
    if (outside >= 0)
      EXPECT_NEAR(part.gap(x).distance, outside, 1e-14) << x.transpose();
    else
      EXPECT_LT(part.gap(x).distance, 1e-14);
    expect_normal(part, x);
  }
}

TEST(RigidSurface, ASphereOfTrianglesAgreesWithItsPointsInsideAndOutside) {
  Domain ball = test::box_domain(-Vec3::Ones(), Vec3::Ones(), 8);
  for (Vec3& x : ball.vertices)
    x.normalize();
  const RigidSurface surface(ball);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  const double longest = 0.4, sag = longest * longest / 4; // of its triangles' edges; below the sphere
  for (int i = 0; i < 300; ++i) {
    const Vec3 x(place(random), place(random), place(random));
    const double distance = surface.gap(x).distance;
    EXPECT_LE(distance, x.norm() - 1 + sag);
    EXPECT_GE(distance, x.norm() - 1 - 1e-14);
    if (i < 60) {
      const double sampled = sampled_distance(ball, x, 16), between = longest / 16;
      EXPECT_LE(std::abs(distance), sampled + 1e-14);
      EXPECT_GE(std::hypot(distance, between), sampled);
    }
    expect_normal(surface, x);
  }
}

TEST(RigidSurface, ASharpWedgeIsNotMistakenForItsOtherSide) {
  // A needle of a tetrahedron: around its edges and tips one face alone often tells the wrong side.
  const Domain needle = facets_only({{0, 0, 0}, {3, 0.1, 0}, {3, -0.1, 0.05}, {2.9, 0, 0.3}},
                                    {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  const RigidSurface surface(needle);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  int wrong_by_face = 0;
  for (int i = 0; i < 4000; ++i) {
    const double t = (place(random) + 0.5) * 3.4 - 0.2;
    const Vec3 x(t, 0.4 * place(random), 0.8 * place(random));
    double outside = -INFINITY;
    for (const Domain::Facet& f : needle.facets) {
      const Vec3 &a = needle.vertices[f.vertices[0]], &b = needle.vertices[f.vertices[1]],
                 &c = needle.vertices[f.vertices[2]];
      outside = std::max(outside, (b - a).cross(c - a).normalized().dot(x - a));
    }
    EXPECT_EQ(surface.gap(x).distance > 0, outside > 0) << x.transpose();
    EXPECT_GE(surface.gap(x).distance, outside - 1e-14);
    const Vec3 nearest = x - surface.gap(x).distance * surface.gap(x).normal;
    for (const Domain::Facet& f : needle.facets) {
      const Vec3 &a = needle.vertices[f.vertices[0]], &b = needle.vertices[f.vertices[1]],
                 &c = needle.vertices[f.vertices[2]];
      const Vec3 n = (b - a).cross(c - a).normalized();
      wrong_by_face += outside > 0 && std::abs(n.dot(nearest - a)) < 1e-12 && n.dot(x - nearest) < 0;
    }
  }
  EXPECT_GT(wrong_by_face, 100); // so there was something to mistake
}

TEST(RigidSurface, AnswersAreTheSameFromManyThreads) {
  const RigidSurface surface(test::holed_domain(4));
  const std::vector<Vec3> points = around({0, 0, 0}, {1, 1, 0.5}, 20);
  const auto n = static_cast<std::int64_t>(points.size());
  std::vector<double> one(points.size()), many(points.size());
  set_threads(1);
  for_each(n, [&](std::int64_t i) { one[i] = surface.gap(points[i]).distance; });
  set_threads(4);
  for_each(n, [&](std::int64_t i) { many[i] = surface.gap(points[i]).distance; });
  set_threads(1);
  EXPECT_EQ(one, many);
}

TEST(RigidSurface, RefusesASurfaceThatTouchesItself) {
  // Two tetrahedra that share an edge.
  const Domain twins =
      facets_only({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                  {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}});
  try {
    RigidSurface surface(twins, "case.toml:3:1");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("touches itself along the edge at (0, 0, "), std::string::npos)
        << e.what();
    EXPECT_NE(std::string(e.what()).find("case.toml:3:1"), std::string::npos);
  }
}
