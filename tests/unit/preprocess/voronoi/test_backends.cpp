/// The clipper against Voro++, which finds its own neighbours and cuts its own cells.
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"
#include "tests/support/tessellation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

using test::random_points;
using test::Tessellation;

/// Every cell of both backends: volume, moment and each surface's area, in units of the spacing.
void expect_agreement(const Domain& domain, const std::vector<Vec3>& X) {
  const Tessellation t(domain, X);
  const CellMeasures own = measure_cells(t.voronoi);
  const DelaunayGraph graph = voro_neighbours(t.body, t.seeds);
  const CellMeasures voro = measure_cells(RestrictedVoronoi(t.body, t.seeds, graph, Backend::voro));
  constexpr double bound = 1e-11;
  for (std::size_t i = 0; i < X.size(); ++i) {
    ASSERT_NEAR(own.volume[i], voro.volume[i], bound) << i;
    ASSERT_LE((own.moment[i] - voro.moment[i]).norm(), bound) << i;
    std::vector<Vec3> area(domain.surfaces.size(), Vec3::Zero());
    for (const auto& share : own.shares[i])
      area[share.surface] += share.area;
    for (const auto& share : voro.shares[i])
      area[share.surface] -= share.area;
    for (const Vec3& difference : area)
      ASSERT_LE(difference.norm(), bound) << i;
  }
  EXPECT_LE(voro.closure_error, bound);
}

std::vector<Vec3> lattice_of_l(int per_unit) {
  std::vector<Vec3> X;
  for (int k = 0; k <= per_unit; ++k)
    for (int j = 0; j <= 2 * per_unit; ++j)
      for (int i = 0; i <= 2 * per_unit; ++i)
        if (i <= per_unit || j <= per_unit)
          X.push_back(Vec3(i, j, k) / per_unit);
  return X;
}

} // namespace

TEST(Backends, AgreeOnAnLPart) {
  const Domain domain = test::l_domain(3);
  expect_agreement(domain, random_points(domain, 2000));
}

TEST(Backends, AgreeOnALatticeOfAnLPart) {
  expect_agreement(test::l_domain(2), lattice_of_l(6));
  expect_agreement(test::l_domain(2), lattice_of_l(7));
}

TEST(Backends, AgreeOnAHoledBody) {
  const Domain domain = test::holed_domain(3);
  expect_agreement(domain, random_points(domain, 2000));
}

TEST(Backends, AgreeOnALatticeOfAHoledBody) {
  std::vector<Vec3> X;
  for (int k = 0; k <= 5; ++k)
    for (int j = 0; j <= 10; ++j)
      for (int i = 0; i <= 10; ++i)
        if (std::hypot(i - 5, j - 5) > 3)
          X.push_back(Vec3(i, j, k) / 10);
  expect_agreement(test::holed_domain(3), X);
}

TEST(Backends, AgreeAcrossASlot) {
  const Domain domain = test::slotted_domain(3, 0.02);
  expect_agreement(domain, random_points(domain, 500));
}

TEST(Backends, AgreeInThePlane) {
  for (const Domain& domain : {test::l_slab(3), test::holed_slab(4)})
    expect_agreement(domain, random_points(domain, 1000));
}

TEST(Backends, FindTheSameNeighbours) {
  // Faces of random cells have area: what Voro++ sees is what Delaunay's triangulation has, except faces
  // beyond the box of the body.
  const Domain domain = test::l_domain(3);
  const Tessellation t(domain, random_points(domain, 1000));
  const DelaunayGraph voro = voro_neighbours(t.body, t.seeds);
  for (std::int64_t i = 0; i < t.voronoi.size(); ++i) {
    const auto known = t.graph.of(i);
    for (const std::int32_t j : voro.of(i))
      EXPECT_TRUE(std::find(known.begin(), known.end(), j) != known.end()) << i << ' ' << j;
    if (!t.voronoi.meets_boundary(i)) {
      t.voronoi.visit(i, [&](const CellPiece& piece) {
        for (const auto& face : piece.cell.faces())
          EXPECT_TRUE(std::find(voro.of(i).begin(), voro.of(i).end(), face.label) != voro.of(i).end());
      });
    }
  }
}

} // namespace tessera::preprocess
