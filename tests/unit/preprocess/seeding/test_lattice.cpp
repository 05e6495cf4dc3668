#include "core/error.hpp"
#include "preprocess/seeding/lattice.hpp"
#include "preprocess/voronoi/delaunay.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

std::int64_t cubic_count(const Domain& domain, double spacing) {
  return lattice_count(domain, CadTopology(domain), {LatticeKind::cubic, spacing});
}

/// The cube [-1, 1]^3 blown up to a ball.
Domain ball() {
  Domain domain = test::box_domain(Vec3::Constant(-1), Vec3::Constant(1), 10);
  for (Vec3& X : domain.vertices)
    if (const double size = X.cwiseAbs().maxCoeff(); size > 0)
      X *= size / X.norm();
  domain.corners.clear();
  domain.feature_edges.clear();
  domain.measure();
  return domain;
}

/// [-1, 1]^2 x [0, 3] blown up to a cylinder of radius 1.
Domain cylinder() {
  Domain domain = test::box_domain(Vec3(-1, -1, 0), Vec3(1, 1, 3), 10);
  for (Vec3& X : domain.vertices) {
    const double size = std::max(std::abs(X.x()), std::abs(X.y())), radius = std::hypot(X.x(), X.y());
    if (radius > 0)
      X.head<2>() *= size / radius;
  }
  domain.measure();
  return domain;
}

TEST(Lattice, CountsOfBoxAndLShape) {
  const Domain box = test::box_domain(), ell = test::l_domain(2);
  EXPECT_EQ(cubic_count(box, 0.125), 9 * 9 * 9);
  EXPECT_EQ(cubic_count(box, 0.3), 4 * 4 * 4);
  // The notch's faces carry points: (17^2 - 8^2) columns of 9.
  EXPECT_EQ(cubic_count(ell, 0.125), (17 * 17 - 8 * 8) * 9);
}

TEST(Lattice, ScanAgreesWithTheDefinitionPointByPoint) {
  // A tilted block: no face is parallel to the lattice.
  Domain tilted = test::box_domain(Vec3::Constant(-0.5), Vec3::Constant(0.5), 2);
  const Mat3 turn = (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(0.7, Vec3::UnitZ())).matrix();
  for (Vec3& X : tilted.vertices)
    X = turn * X;
  tilted.measure();
  const Lattice lattice = lattice_points(tilted, CadTopology(tilted), {LatticeKind::cubic, 0.04});
  const double band = lattice_band * lattice.spec.spacing;
  std::size_t at = 0;
  for (std::int32_t i = 0; i < lattice.counts[0]; ++i)
    for (std::int32_t j = 0; j < lattice.counts[1]; ++j)
      for (std::int32_t k = 0; k < lattice.counts[2]; ++k) {
        const Vec3 local = turn.transpose() * (lattice.origin + lattice.spec.spacing * Vec3(i, j, k));
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

TEST(Lattice, EveryKindHasItsNearestDistanceDensityAndNeighbours) {
  struct Kind {
    LatticeKind kind;
    double volume;  ///< of a cell, in spacings
    int neighbours; ///< at the nearest distance
  };
  const Domain box = test::box_domain(Vec3::Zero(), Vec3(1, 1.1, 0.9), 2);
  const CadTopology cad(box);
  for (const Kind& k :
       {Kind{LatticeKind::cubic, 1, 6}, Kind{LatticeKind::body_centred, 4 / std::sqrt(27.), 8},
        Kind{LatticeKind::hexagonal, std::sqrt(0.5), 12}}) {
    constexpr double h = 0.05;
    const Lattice lattice = lattice_points(box, cad, {k.kind, h});
    std::vector<Vec3> whole;
    for (std::size_t i = 0; i < lattice.index.size(); ++i)
      whole.push_back(lattice.whole_numbers(i));
    const DelaunayGraph graph = delaunay_graph(whole);
    int inner = 0;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(whole.size()); ++i) {
      const Vec3 X = lattice.position(i);
      for (int a = 0; a < 3; ++a)
        EXPECT_EQ(whole[i][a], std::round(whole[i][a]));
      int nearest = 0;
      for (const std::int32_t j : graph.of(i)) {
        const double apart = (lattice.position(j) - X).norm();
        EXPECT_GE(apart, h * (1 - 1e-12));
        nearest += apart < h * (1 + 1e-12);
      }
      const bool inside = (X - box.lower).minCoeff() > 2 * h && (box.upper - X).minCoeff() > 2 * h;
      if (inside) {
        EXPECT_EQ(nearest, k.neighbours);
      }
      inner += inside;
    }
    EXPECT_GT(inner, 1000);
    // Points on the faces count in full: a few per cent more than the volume holds.
    const auto many = static_cast<double>(lattice_count(box, cad, {k.kind, 0.01}));
    EXPECT_NEAR(many * k.volume * 1e-6, 1.025 * box.volume, 0.03 * box.volume);
  }
}

TEST(Lattice, EveryKindHasPointsOnTheFacesOfABoxThatFits) {
  constexpr double h = 0.1;
  const Vec3 cell = h * Vec3(1, std::sqrt(3), std::sqrt(8. / 3)); // of the hexagonal kind
  const double side = 2 * h / std::sqrt(3);
  for (const auto& [kind, size] :
       {std::pair{LatticeKind::cubic, Vec3(5 * h, 4 * h, 3 * h)},
        std::pair{LatticeKind::body_centred, Vec3(5 * side, 4 * side, 3 * side)},
        std::pair{LatticeKind::hexagonal, Vec3(5 * cell.x(), 3 * cell.y(), 2 * cell.z())}}) {
    const Domain box = test::box_domain(Vec3(1, 2, 3), Vec3(1, 2, 3) + size, 1);
    const Lattice lattice = lattice_points(box, CadTopology(box), {kind, h});
    std::array<int, 6> on{};
    int corners = 0;
    for (std::size_t i = 0; i < lattice.index.size(); ++i)
      for (int a = 0; a < 3; ++a) {
        on[2 * a] += std::abs(lattice.position(i)[a] - box.lower[a]) < 1e-12;
        on[2 * a + 1] += std::abs(lattice.position(i)[a] - box.upper[a]) < 1e-12;
        corners += a == 0 && lattice.place[i].dimension == 0;
      }
    EXPECT_EQ(corners, 8);
    for (const int points : on)
      EXPECT_GE(points, 12);
  }
}

TEST(Lattice, PlaneBodiesCarrySquaresOrTriangles) {
  const Domain square = test::square_slab(3);
  const CadTopology cad(square);
  for (const LatticeKind kind : {LatticeKind::cubic, LatticeKind::hexagonal}) {
    constexpr double h = 1. / 16;
    const Lattice lattice = lattice_points(square, cad, {kind, h});
    // 17 rows of 17; or rows every sqrt(3)/2 h, 17 and 16 points in turn.
    EXPECT_EQ(lattice.index.size(), kind == LatticeKind::cubic ? 17u * 17u : 10u * 17u + 9u * 16u);
    std::array<int, 3> of_dimension{};
    for (std::size_t i = 0; i < lattice.index.size(); ++i) {
      const Vec3 X = lattice.position(i);
      EXPECT_EQ(X.z(), 0);
      const int sides = (X.x() == 0) + (X.x() == 1) + (X.y() == 0) + (X.y() == 1);
      EXPECT_EQ(lattice.place[i].dimension, 2 - sides);
      if (lattice.place[i].dimension == 1) {
        // The wall it names is the one it lies on.
        const auto on_wall = [&](const Domain::Facet& f) {
          return f.surface == lattice.place[i].entity &&
                 std::all_of(f.vertices.begin(), f.vertices.end(), [&](std::int32_t v) {
                   const Vec3& W = square.vertices[v];
                   return (X.x() == W.x() && (X.x() == 0 || X.x() == 1)) ||
                          (X.y() == W.y() && (X.y() == 0 || X.y() == 1));
                 });
        };
        EXPECT_TRUE(std::any_of(square.facets.begin(), square.facets.end(), on_wall));
      }
      ++of_dimension[lattice.place[i].dimension];
    }
    if (kind == LatticeKind::cubic) {
      EXPECT_EQ(of_dimension, (std::array{4, 4 * 15, 15 * 15}));
    }
  }
  EXPECT_THROW(lattice_points(square, cad, {LatticeKind::body_centred, 0.1}), InputError);
  // However wide the spacing against the slab's thickness of one.
  const Domain wide = test::square_slab(3, 1000);
  EXPECT_EQ(lattice_count(wide, CadTopology(wide), {LatticeKind::cubic, 62.5}), 17 * 17);
}

TEST(Lattice, ShiftMovesThePoints) {
  const Domain box = test::box_domain();
  const CadTopology cad(box);
  EXPECT_EQ(lattice_count(box, cad, {LatticeKind::cubic, 0.125, Vec3(0.5, 0, 0)}), 8 * 9 * 9);
  EXPECT_EQ(lattice_count(box, cad, {LatticeKind::cubic, 0.125, Vec3(0.5, 0.5, -0.5)}), 8 * 8 * 8);
  const Lattice lattice = lattice_points(box, cad, {LatticeKind::cubic, 0.125, Vec3(0.25, 0, 0)});
  for (std::size_t i = 0; i < lattice.index.size(); ++i)
    EXPECT_EQ(std::fmod(lattice.position(i).x(), 0.125), 0.03125);
}

TEST(LatticeForCount, PrefersPointsOnTheFaces) {
  const Domain box = test::box_domain(), ell = test::l_domain(2);
  const auto spacing = [](const Domain& domain, std::int64_t count) {
    const FittedLattice fitted = lattice_for_count(domain, CadTopology(domain), LatticeKind::cubic, count);
    EXPECT_EQ(fitted.count, lattice_count(domain, CadTopology(domain), fitted.spec));
    EXPECT_EQ(fitted.spec.shift, Vec3(Vec3::Zero()));
    return fitted.spec.spacing;
  };
  EXPECT_DOUBLE_EQ(spacing(box, 729), 0.125);
  EXPECT_DOUBLE_EQ(spacing(box, 740), 0.125);
  EXPECT_DOUBLE_EQ(spacing(ell, 2000), 0.125);
  EXPECT_DOUBLE_EQ(spacing(ell, 51376), 0.04);
}

TEST(LatticeForCount, IsWithinTwoPerCent) {
  for (const Domain& domain :
       {test::box_domain(Vec3::Zero(), Vec3(1, 1.7, 0.6), 2), test::l_domain(2), ball(), cylinder(),
        test::square_slab(2), test::l_slab(2), test::holed_slab(3)}) {
    const CadTopology cad(domain);
    for (const LatticeKind kind : {LatticeKind::cubic, LatticeKind::body_centred, LatticeKind::hexagonal}) {
      if (domain.dimension == 2 && kind == LatticeKind::body_centred)
        continue;
      for (const std::int64_t count : {300, 2500, 50000})
        EXPECT_NEAR(static_cast<double>(lattice_for_count(domain, cad, kind, count).count),
                    static_cast<double>(count), 0.02 * static_cast<double>(count));
    }
  }
}

TEST(LatticeForCount, ComesAsNearAsACubeAllows) {
  const Domain box = test::box_domain();
  const CadTopology cad(box);
  // Of 7 or 8 points a side there are 392 or 448.
  EXPECT_EQ(lattice_for_count(box, cad, LatticeKind::cubic, 400).count, 392);
  EXPECT_EQ(lattice_for_count(box, cad, LatticeKind::cubic, 440).count, 448);
  for (const std::int64_t count : {300, 560, 1660, 3457, 10385}) {
    const auto wanted = static_cast<double>(count);
    EXPECT_NEAR(static_cast<double>(lattice_for_count(box, cad, LatticeKind::cubic, count).count), wanted,
                wanted * std::max(0.02, 0.5 / std::cbrt(wanted)));
  }
}

} // namespace
} // namespace tessera::preprocess
