#include "preprocess/seeding/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tessera::preprocess {
namespace {

TEST(Orientation, IsExactWhereRoundingIsNot) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), -1);
  // In line, and off the line by one last bit, where the rounded determinant knows neither.
  const double tiny = std::nextafter(0.5, 1) - 0.5;
  EXPECT_EQ(orientation({0.5, 0.5}, {12, 12}, {24, 24}), 0);
  EXPECT_EQ(orientation({0.5, 0.5 + tiny}, {12, 12}, {24, 24}), 1);
  EXPECT_EQ(orientation({0.5, 0.5 - tiny}, {12, 12}, {24, 24}), -1);
}

TEST(Orientation, PerturbedPointIsInExactlyOneOfTheTrianglesAroundAVertex) {
  // A fan of triangles around a vertex with the query on the vertex and on every spoke.
  const std::vector<Point2> rim{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  std::vector<Point2> queries{{0, 0}};
  for (const Point2& p : rim)
    queries.push_back({p.x / 2, p.y / 2});
  for (const Point2& q : queries) {
    int inside = 0;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const Point2 a{0, 0}, b = rim[k], c = rim[(k + 1) % rim.size()];
      inside += orientation_perturbed(a, b, q) > 0 && orientation_perturbed(b, c, q) > 0 &&
                orientation_perturbed(c, a, q) > 0;
    }
    EXPECT_EQ(inside, 1);
  }
}

} // namespace
} // namespace tessera::preprocess
