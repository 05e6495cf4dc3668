#include "preprocess/voronoi/convex_cell.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <utility>

namespace tessera::preprocess {
namespace {

ConvexCell unit_cube() {
  ConvexCell cell;
  cell.set_box(Vec3::Zero(), Vec3::Ones());
  return cell;
}

/// Every directed edge has its reverse exactly once: the loops close whatever the rounding.
void expect_closed(const ConvexCell& cell) {
  std::map<std::pair<int, int>, int> edges;
  Vec3 area = Vec3::Zero();
  for (const auto& face : cell.faces()) {
    const auto loop = cell.loop(face);
    for (std::size_t k = 0; k < loop.size(); ++k)
      ++edges[{loop[k], loop[(k + 1) % loop.size()]}];
    area += cell.area(face);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_LE(area.norm(), 1e-15); // coordinates of order 1 round at 1e-16, however thin the sliver
}

TEST(ConvexCell, BoxHasItsVolumeMomentAndLabels) {
  const ConvexCell cell = unit_cube();
  const auto m = cell.measure(Vec3(0.25, 0.5, 0.5));
  EXPECT_DOUBLE_EQ(m.volume, 1);
  EXPECT_LE((m.moment - Vec3(0.25, 0, 0)).norm(), 1e-16);
  for (const auto& face : cell.faces()) {
    const int k = -1 - face.label;
    Vec3 outward = Vec3::Zero();
    outward[k / 2] = k % 2 ? 1 : -1;
    EXPECT_LE((cell.area(face) - outward).norm(), 1e-16);
  }
}

TEST(ConvexCell, TetrahedronFacesPointOutwardOppositeToTheirCorner) {
  ConvexCell cell;
  const std::array<Vec3, 4> X{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  cell.set_tetrahedron(X[0], X[1], X[2], X[3]);
  EXPECT_DOUBLE_EQ(cell.measure(Vec3::Zero()).volume, 1. / 6);
  for (const auto& face : cell.faces())
    EXPECT_LT(cell.area(face).dot(X[-1 - face.label] - cell.vertices()[cell.loop(face)[0]]), 0);
  expect_closed(cell);
}

TEST(ConvexCell, CutThroughVerticesAndAlongFaces) {
  ConvexCell half = unit_cube();
  EXPECT_TRUE(half.clip(Vec3(1, 1, 0), Vec3(1, 0, 0), 7)); // through four vertices
  EXPECT_NEAR(half.measure(Vec3::Zero()).volume, 0.5, 1e-15);
  expect_closed(half);
  ConvexCell touched = unit_cube();
  EXPECT_TRUE(touched.clip(Vec3(1, 0, 0), Vec3(1, 0, 0), 7)); // along a face, body kept
  EXPECT_EQ(touched.faces().size(), 6u);
  EXPECT_FALSE(touched.clip(Vec3(1, 0, 0), Vec3(0, 0, 0), 8)); // along a face, body lost
  EXPECT_TRUE(touched.empty());
}

TEST(ConvexCell, TwoSidesOfAPlaneShareTheirCutBitByBit) {
  std::mt19937_64 bits(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 normal(uniform(bits) - 0.5, uniform(bits) - 0.5, uniform(bits) - 0.5);
    const Vec3 point(uniform(bits), uniform(bits), uniform(bits));
    ConvexCell one = unit_cube(), other = unit_cube();
    ASSERT_TRUE(one.clip(normal, point, 1));
    ASSERT_TRUE(other.clip(-normal, point, 1));
    const auto& cap = one.faces().back();
    for (const int v : one.loop(cap)) {
      const auto& mirror = other.faces().back();
      bool found = false;
      for (const int w : other.loop(mirror))
        found |= one.vertices()[v] == other.vertices()[w];
      EXPECT_TRUE(found);
    }
  }
}

TEST(ConvexCell, DegeneratePartitionsStayClosedAndSumToTheWhole) {
  // Planes through few points of a coarse grid, perturbed by nothing or by the last bits: many pass through
  // vertices, edges and faces at once. Each plane splits every piece in two; the pieces must still fill the
  // cube.
  std::mt19937_64 bits(11);
  const auto grid = [&] { return static_cast<double>(bits() % 5) / 4; };
  const auto hair = [&] { return bits() % 2 ? 0.0 : (static_cast<double>(bits() % 9) - 4) * 1.1e-16; };
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<ConvexCell> pieces{unit_cube()};
    for (int plane = 0; plane < 4; ++plane) {
      const Vec3 a(grid(), grid(), grid()), b(grid(), grid(), grid()), c(grid(), grid(), grid());
      Vec3 normal = (b - a).cross(c - a);
      if (normal.norm() == 0)
        continue;
      normal += Vec3(hair(), hair(), hair());
      const Vec3 point = a + Vec3(hair(), hair(), hair());
      std::vector<ConvexCell> next;
      for (const ConvexCell& piece : pieces) {
        ConvexCell below = piece, above = piece;
        if (below.clip(normal, point, plane))
          next.push_back(below);
        if (above.clip(-normal, point, plane))
          next.push_back(above);
      }
      pieces = std::move(next);
    }
    double volume = 0;
    for (const ConvexCell& piece : pieces) {
      volume += piece.measure(Vec3::Constant(0.5)).volume;
      expect_closed(piece);
    }
    ASSERT_NEAR(volume, 1, 4e-15) << "trial " << trial;
  }
}

} // namespace
} // namespace tessera::preprocess
