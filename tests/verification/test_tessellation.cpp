/// What every tessellation must hold, whatever the body's size and place: the cells fill the body, close,
/// keep its first moment and share out each of its surfaces.
#include "core/parallel.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"
#include "tests/support/tessellation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tessera::preprocess {
namespace {

using test::random_points;
using test::Tessellation;

/// Integral of (x - middle) over the body, in metres.
Vec3 first_moment(const Domain& domain, const Vec3& middle) {
  Vec3 total = Vec3::Zero();
  for (std::size_t t = 0; t < domain.tets.size(); ++t) {
    Vec3 centroid = Vec3::Zero();
    for (const std::int32_t v : domain.tets[t])
      centroid += (domain.vertices[v] - middle) / 4;
    total += domain.tet_volume(t) * centroid;
  }
  return total;
}

void expect_exact(const Domain& domain, const std::vector<Vec3>& X) {
  const Tessellation t(domain, X);
  const CellMeasures measures = measure_cells(t.voronoi);
  EXPECT_LE(measures.closure_error, 1e-12);

  const Vec3 middle = (domain.lower + domain.upper) / 2;
  const double size = (domain.upper - domain.lower).norm();
  double volume = 0, smallest = measures.volume[0];
  Vec3 moment = Vec3::Zero();
  std::vector<Vec3> area(domain.surfaces.size(), Vec3::Zero());
  for (std::size_t i = 0; i < X.size(); ++i) {
    smallest = std::min(smallest, measures.volume[i]);
    volume += t.volume(measures.volume[i]);
    moment += t.volume(1) * (measures.volume[i] * t.seeds[i] + measures.moment[i]) * t.body.scaling.length;
    for (const auto& share : measures.shares[i])
      area[share.surface] += share.area * t.body.scaling.area();
  }
  EXPECT_GE(smallest, 0);
  EXPECT_NEAR(volume / domain.volume, 1, 1e-12);
  moment += volume * (t.body.scaling.centre - middle);
  Vec3 expected_moment = first_moment(domain, middle);
  if (domain.dimension == 2)
    expected_moment.z() = 0; // rounding of tetrahedra that lie evenly about z = 0
  EXPECT_LE((moment - expected_moment).norm(), 1e-12 * domain.volume * size);

  std::vector<Vec3> expected(domain.surfaces.size(), Vec3::Zero());
  double whole = 0;
  for (const auto& facet : domain.facets) {
    if (facet.surface == Domain::lid)
      continue;
    const Vec3& a = domain.vertices[facet.vertices[0]];
    const Vec3 part =
        (domain.vertices[facet.vertices[1]] - a).cross(domain.vertices[facet.vertices[2]] - a) / 2;
    expected[facet.surface] += part;
    whole += part.norm();
  }
  for (std::size_t s = 0; s < area.size(); ++s)
    EXPECT_LE((area[s] - expected[s]).norm(), 1e-12 * whole) << domain.surfaces[s];
}

class Scales : public testing::TestWithParam<double> {};

TEST_P(Scales, RandomSeedsOfASolid) {
  const Domain domain = test::l_domain(3, GetParam(), 0.3 * GetParam() * Vec3(1, -2, 3));
  expect_exact(domain, random_points(domain, 3000));
}

TEST_P(Scales, RandomSeedsOfASlottedSolid) {
  const Domain domain = test::slotted_domain(3, 0.03, GetParam());
  expect_exact(domain, random_points(domain, 2000));
}

TEST_P(Scales, LatticeOfASolid) {
  // Seeds on faces, edges and corners; every bisector plane passes through mesh vertices or along mesh faces.
  const double scale = GetParam();
  const Domain domain = test::l_domain(2, scale);
  std::vector<Vec3> X;
  for (int k = 0; k <= 8; ++k)
    for (int j = 0; j <= 16; ++j)
      for (int i = 0; i <= 16; ++i)
        if (i <= 8 || j <= 8)
          X.push_back(scale / 8 * Vec3(i, j, k));
  expect_exact(domain, X);
}

TEST_P(Scales, RandomSeedsOfAPlaneBody) {
  const Vec<2> offset = 0.3 * GetParam() * Vec<2>(1, -2);
  for (const Domain& domain : {test::l_slab(3, GetParam(), offset), test::holed_slab(4, GetParam(), offset)})
    expect_exact(domain, random_points(domain, 3000));
}

TEST_P(Scales, LatticesOfAPlaneBody) {
  const double scale = GetParam();
  const Domain domain = test::l_slab(2, scale);
  std::vector<Vec3> square, triangular;
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i)
      if (i <= 20 || j <= 20) {
        square.push_back(scale / 20 * Vec3(i, j, 0));
        if (j % 2 == 0 || (i < 20 || (i < 40 && j <= 20)))
          triangular.push_back(scale / 20 * Vec3(i + 0.5 * (j % 2), j, 0));
      }
  expect_exact(domain, square);
  expect_exact(domain, triangular);
}

INSTANTIATE_TEST_SUITE_P(FromMicronsToKilometres, Scales, testing::Values(1e-6, 1e-3, 1.0, 1e3));

TEST(Slot, SidesWithoutASeedAreStrandedOrTakenFromAfar) {
  // All seeds on one side: the other side hangs together with them through the foot alone.
  const Domain domain = test::slotted_domain(4, 0.02);
  std::vector<Vec3> X;
  for (const Vec3& x : random_points(domain, 800))
    if (x.x() < 1.02)
      X.push_back(x);
  const Tessellation t(domain, X);
  const CellMeasures measures = measure_cells(t.voronoi);
  EXPECT_GT(measures.orphans.size(), 20u);
  EXPECT_EQ(measures.stranded, 0) << "all can be reached through the foot";
  double sum = 0;
  for (const double v : measures.volume)
    sum += t.volume(v);
  EXPECT_NEAR(sum, domain.volume, 1e-12);
}

TEST(Slot, APieceWithoutASeedIsReported) {
  // Two blocks that do not touch: the second one has no seed.
  Domain domain = test::box_domain(Vec3::Zero(), Vec3::Ones(), 2);
  const Domain other = test::box_domain(Vec3(1.5, 0, 0), Vec3(2.5, 1, 1), 2);
  const auto vertices = static_cast<std::int32_t>(domain.vertices.size()),
             tets = static_cast<std::int32_t>(domain.tets.size());
  const std::vector<Vec3> X = random_points(domain, 50);
  domain.vertices.insert(domain.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (auto tet : other.tets) {
    for (std::int32_t& v : tet)
      v += vertices;
    domain.tets.push_back(tet);
  }
  for (auto facet : other.facets) {
    for (std::int32_t& v : facet.vertices)
      v += vertices;
    facet.tet += tets;
    domain.facets.push_back(facet);
  }
  domain.measure();
  const Tessellation t(domain, X);
  const CellMeasures measures = measure_cells(t.voronoi);
  double orphaned = 0;
  for (const auto& orphan : measures.orphans) {
    EXPECT_EQ(orphan.receiver, orphan.cell);
    orphaned += t.volume(orphan.volume);
  }
  EXPECT_NEAR(t.volume(measures.stranded), 1, 1e-12);
  EXPECT_NEAR(orphaned, 1, 1e-12);
}

TEST(Slot, FewOrphansRemainOnceTheLargeOnesAreParticles) {
  // A block of 40 mm with a slot of 0.5 mm, particles 2 mm apart.
  const double scale = 20e-3;
  const Domain domain = test::slotted_domain(4, 0.5e-3 / scale, scale);
  std::vector<Vec3> X = random_points(domain, static_cast<int>(domain.volume / std::pow(2e-3, 3)));
  const auto first = X.size();
  // A particle put in can reach across the slot in its turn: each round leaves far less.
  constexpr int rounds = 4;
  std::vector<double> orphaned;
  for (int round = 0; round <= rounds; ++round) {
    const Tessellation t(domain, X);
    const CellMeasures measures = measure_cells(t.voronoi);
    EXPECT_EQ(measures.stranded, 0);
    const double mean = domain.volume / t.volume(1) / static_cast<double>(X.size());
    orphaned.push_back(0);
    for (const auto& orphan : measures.orphans) {
      orphaned.back() += t.volume(orphan.volume) / domain.volume;
      if (orphan.volume > 0.05 * mean)
        X.push_back(t.body.scaling.out(orphan.inside));
    }
  }
  EXPECT_GT(orphaned.front(), 4e-3);
  EXPECT_LT(orphaned.back(), 1e-3);
  EXPECT_LT(X.size(), first * 1.1);
  const auto in_slot = [&](const Vec3& x) {
    return x.y() > 0 && std::abs(x.x() - 1.0125 * scale) < 0.2499e-3;
  };
  EXPECT_TRUE(std::none_of(X.begin(), X.end(), in_slot)) << "orphans' points lie in the body";
}

} // namespace
} // namespace tessera::preprocess
