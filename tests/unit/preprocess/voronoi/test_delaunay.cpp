/// One graph whatever the number of threads: point sets are triangulated in as many parts as there are
/// threads.
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "preprocess/voronoi/point_parts.hpp"
#include "preprocess/voronoi/rim.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/tessellation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

class Threads {
 public:
  explicit Threads(int n) { set_threads(n); }
  ~Threads() { set_threads(0); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
};

DelaunayGraph graph_on(int count, const std::vector<Vec3>& points) {
  const Threads threads(count);
  return delaunay_graph(points);
}

void expect_one_graph(const std::vector<Vec3>& points) {
  const DelaunayGraph alone = graph_on(1, points);
  for (const int count : {2, 3, 2}) {
    const DelaunayGraph graph = graph_on(count, points);
    EXPECT_TRUE(graph.rows == alone.rows && graph.columns == alone.columns) << count << " threads";
  }
}

/// Points i a + j b + k c for which a point of the lattice lies in [0, n)^3.
std::vector<Vec3> lattice(int n, const Vec3& a, const Vec3& b, const Vec3& c) {
  std::vector<Vec3> points;
  for (int k = -2 * n; k <= 2 * n; ++k)
    for (int j = -2 * n; j <= 2 * n; ++j)
      for (int i = -2 * n; i <= 2 * n; ++i) {
        const Vec3 x = i * a + j * b + k * c;
        if ((x.array() >= 0).all() && (x.array() < n).all())
          points.push_back(x);
      }
  return points;
}

} // namespace

TEST(DelaunayInParts, RandomPointsOfABody) {
  expect_one_graph(test::random_points(test::l_domain(2), 20000));
}

TEST(DelaunayInParts, CubicLattice) {
  expect_one_graph(lattice(26, Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()));
}

TEST(DelaunayInParts, BodyCentredLattice) {
  expect_one_graph(lattice(21, Vec3(1, 1, 1) / 2, Vec3(-1, 1, 1) / 2, Vec3(1, 1, -1) / 2));
}

TEST(DelaunayInParts, HexagonalLattice) {
  const double height = std::sqrt(0.75);
  expect_one_graph(lattice(25, Vec3::UnitX(), Vec3(0.5, height, 0), Vec3::UnitZ()));
}

TEST(DelaunayInParts, LatticeThatRoundingBends) {
  // Sums of tenths: planes and spheres that nearly, but not exactly, hold more points than they should.
  std::vector<Vec3> points = lattice(26, Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ());
  for (Vec3& x : points)
    x = x * 0.1 + Vec3(0.3, 0.7, 0.1);
  expect_one_graph(points);
}

TEST(DelaunayInParts, PointsOnTheSurfaceOfABodyToo) {
  const Domain ell = test::l_domain(2);
  std::vector<Vec3> points = test::random_points(ell, 8000);
  const std::vector<Vec3> more = test::random_points(ell, 12000, 3);
  for (std::size_t i = 0; i < more.size(); ++i) {
    Vec3 x = more[i]; // pushed onto a side of the box around the body
    x[static_cast<int>(i % 3)] = i % 2 ? 0 : i % 3 == 2 ? 1 : 2;
    points.push_back(x);
  }
  expect_one_graph(points);
}

TEST(DelaunayInParts, PointsOnASphere) {
  // Every point on the hull, all spheres nearly one: no part is sure of anything.
  std::vector<Vec3> points = test::random_points(test::box_domain(-Vec3::Ones(), Vec3::Ones()), 9000);
  for (Vec3& x : points)
    x.normalize();
  expect_one_graph(points);
}

TEST(DelaunayInParts, FlatAndStraightSets) {
  std::vector<Vec3> plane, line;
  for (int i = 0; i < 9000; ++i) {
    plane.emplace_back(i % 90, i / 90, 0);
    line.emplace_back(i, 2 * i, 0);
  }
  expect_one_graph(plane);
  expect_one_graph(line);
}

TEST(DelaunayInParts, RefusesPointsThatCoincideAcrossParts) {
  std::vector<Vec3> points = test::random_points(test::box_domain(), 9000);
  points.emplace_back(0.5, 0.5, 0.5);
  points.emplace_back(0.5, 0.5, 0.5);
  EXPECT_THROW(graph_on(2, points), InputError);
}

TEST(DelaunayInParts, ReachTellsWhoseSpheresStayInTheirPart) {
  // Two clusters along x; tetrahedra of the first one, whose box ends at x = 1.
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0.9, 0.9, 0.9}};
  for (int i = 0; i < 6; ++i)
    points.push_back(points[i] + Vec3(5, 0, 0));
  const PointParts parts(points, 2);
  ASSERT_EQ(parts.members[0], (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(reach_of(points, parts, 0, {0, 1, 2, 3}), Reach::own);
  EXPECT_EQ(reach_of(points, parts, 0, {0, 1, 2, 4}), Reach::unknown) << "flat";
  points[3] = {0, 1e-3, 0.9}; // nearly in line with the others' plane: a large sphere
  EXPECT_EQ(reach_of(points, parts, 0, {0, 2, 3, 1}), Reach::own);
  EXPECT_EQ(reach_of(points, parts, 0, {-1, 0, 2, 3}), Reach::own) << "the hull's far side";
  EXPECT_EQ(reach_of(points, parts, 0, {-1, 0, 3, 2}), Reach::others) << "the same face from behind";
}

TEST(Rim, TellsTheSidesOfAFace) {
  const std::vector<OrientedFace> faces{OrientedFace({7, 3, 5}), OrientedFace({-1, 3, 5})};
  const Rim rim(faces);
  EXPECT_EQ(rim.side(OrientedFace({3, 5, 7})), Rim::Side::inner);
  EXPECT_EQ(rim.side(OrientedFace({5, 3, 7})), Rim::Side::outer);
  EXPECT_EQ(rim.side(OrientedFace({5, -1, 3})), Rim::Side::inner);
  EXPECT_EQ(rim.side(OrientedFace({5, 3, 8})), Rim::Side::none);
}

} // namespace tessera::preprocess
