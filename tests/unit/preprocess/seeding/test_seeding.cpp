#include "preprocess/seeding/lattice.hpp"
#include "preprocess/seeding/orientation.hpp"
#include "preprocess/seeding/random.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(RandomPoints, AreUniformAndTheSameEverywhere) {
  const Domain ell = test::l_domain(2);
  RandomPoints random(ell, 42), again(ell, 42);
  constexpr int n = 30000;
  int in_corner = 0;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < n; ++i) {
    const Vec3 X = random.next();
    ASSERT_EQ(X, again.next());
    ASSERT_TRUE((X.array() >= 0).all() && X.x() <= 2 && X.y() <= 2 && X.z() <= 1 &&
                (X.x() <= 1 || X.y() <= 1));
    in_corner += X.x() < 1 && X.y() < 1;
    mean += X / n;
  }
  EXPECT_NEAR(in_corner / double{n}, 1. / 3, 0.012);
  EXPECT_LE((mean - Vec3(5. / 6, 5. / 6, 0.5)).norm(), 0.015);
}

TEST(Lattice, CountsOfBoxAndLShape) {
  const Domain box = test::box_domain(), ell = test::l_domain(2);
  EXPECT_EQ(lattice_count(box, CadTopology(box), 0.125), 9 * 9 * 9);
  EXPECT_EQ(lattice_count(box, CadTopology(box), 0.3), 4 * 4 * 4);
  // The notch's faces carry points: (17^2 - 8^2) columns of 9.
  EXPECT_EQ(lattice_count(ell, CadTopology(ell), 0.125), (17 * 17 - 8 * 8) * 9);
}

TEST(Lattice, ScanAgreesWithTheDefinitionPointByPoint) {
  // A tilted block: no face is parallel to the lattice.
  Domain tilted = test::box_domain(Vec3::Constant(-0.5), Vec3::Constant(0.5), 2);
  const Mat3 turn = (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(0.7, Vec3::UnitZ())).matrix();
  for (Vec3& X : tilted.vertices)
    X = turn * X;
  tilted.measure();
  const Lattice lattice = lattice_points(tilted, CadTopology(tilted), 0.04);
  const double band = lattice_band * lattice.spacing;
  std::size_t at = 0;
  for (std::int32_t i = 0; i < lattice.counts[0]; ++i)
    for (std::int32_t j = 0; j < lattice.counts[1]; ++j)
      for (std::int32_t k = 0; k < lattice.counts[2]; ++k) {
        const Vec3 local = turn.transpose() * (lattice.origin + lattice.spacing * Vec3(i, j, k));
        const Vec3 beyond = (local.cwiseAbs() - Vec3::Constant(0.5)).cwiseMax(0);
        const bool expected = beyond.norm() <= band;
        const bool found = at < lattice.index.size() && lattice.index[at] == std::array{i, j, k};
        ASSERT_EQ(found, expected) << i << ' ' << j << ' ' << k;
        if (!found)
          continue;
        const bool on_boundary = (local.cwiseAbs() - Vec3::Constant(0.5)).maxCoeff() >= -band;
        EXPECT_EQ(lattice.place[at].dimension < 3, on_boundary);
        ++at;
      }
  EXPECT_EQ(at, lattice.index.size());
}

TEST(Lattice, SpacingForACount) {
  const Domain box = test::box_domain(), ell = test::l_domain(2);
  EXPECT_DOUBLE_EQ(lattice_spacing_for(box, CadTopology(box), 729), 0.125);
  EXPECT_DOUBLE_EQ(lattice_spacing_for(box, CadTopology(box), 740), 0.125); // the nearest there is
  // L-shape: 2025 points at 1/8. Near 50000 there are 48750 with faces left bare, or
  // 51376 at 1/25 with points on all of them: worth half a per cent.
  const CadTopology cad(ell);
  EXPECT_DOUBLE_EQ(lattice_spacing_for(ell, cad, 2000), 0.125);
  EXPECT_DOUBLE_EQ(lattice_spacing_for(ell, cad, 50000), 0.04);
  EXPECT_EQ(lattice_count(ell, cad, 0.04), 51376);
}

} // namespace
} // namespace tessera::preprocess
