#include "preprocess/cloud/visibility.hpp"

#include "core/neighbours.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace tessera::preprocess {
namespace {

ParticleCloud cloud_of(const Domain& domain, Arrangement arrangement, double spacing) {
  ParticleRequest request;
  request.arrangement = arrangement;
  request.spacing = spacing;
  return prepare(domain, request, Progress::silent()).cloud;
}

/// How long a part of the way from a to b lies in the L's notch, x > 1 and y > 1.
double in_notch(const Vec3& a, const Vec3& b) {
  double from = 0, to = 1;
  for (int c = 0; c < 2; ++c) {
    const double d = b[c] - a[c];
    if (d == 0 && a[c] <= 1)
      return 0;
    if (d > 0)
      from = std::max(from, (1 - a[c]) / d);
    else if (d < 0)
      to = std::min(to, (1 - a[c]) / d);
  }
  return std::max(0.0, to - from) * (b - a).norm();
}

class Visibility : public testing::TestWithParam<Arrangement> {};
INSTANTIATE_TEST_SUITE_P(Arrangements, Visibility,
                         testing::Values(Arrangement::lattice, Arrangement::voronoi));

TEST_P(Visibility, HiddenPairsOfTheLAreThoseWhoseWayLeavesIt) {
  const ParticleCloud cloud = cloud_of(test::l_domain(2), GetParam(), 0.17);
  ASSERT_EQ(cloud.sight.size(), cloud.X.size());
  const Neighbours near = find_neighbours(cloud.X, cloud.sight);
  std::int64_t hidden = 0;
  for (std::int32_t a = 0; a < cloud.size(); ++a)
    for (std::int64_t e = near.row[a]; e < near.row[a + 1]; ++e) {
      const std::int32_t b = near.column[e];
      const double outside = in_notch(cloud.centroid[a], cloud.centroid[b]);
      if (outside > 1e-9) {
        EXPECT_TRUE(cloud.hidden.contains(a, b)) << a << ' ' << b << ' ' << outside;
        ++hidden;
      } else if (outside == 0) {
        EXPECT_FALSE(cloud.hidden.contains(a, b)) << a << ' ' << b;
      }
    }
  EXPECT_GT(hidden, 20);
  EXPECT_GE(2 * static_cast<std::int64_t>(cloud.hidden.pairs().size()), hidden);
}

TEST_P(Visibility, InAConvexBodyAllSeeAll) {
  EXPECT_TRUE(cloud_of(test::box_domain(), GetParam(), 0.13).hidden.pairs().empty());
}

TEST(HiddenPairs, AreLookedUpFromBothEnds) {
  const HiddenPairs hidden(5, {{0, 3}, {1, 3}, {3, 4}});
  for (const auto& [a, b] : hidden.pairs()) {
    EXPECT_TRUE(hidden.contains(a, b));
    EXPECT_TRUE(hidden.contains(b, a));
  }
  EXPECT_FALSE(hidden.contains(0, 1));
  EXPECT_FALSE(hidden.contains(2, 3));
  EXPECT_FALSE(HiddenPairs().contains(0, 1));
}

TEST(HiddenPairs, AreNoNeighbours) {
  const std::vector<Vec3> X{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  const HiddenPairs hidden(3, {{0, 1}});
  const Neighbours found = find_neighbours(X, {2.5, 2.5, 2.5}, hidden);
  EXPECT_EQ(found.count(0), 1);
  EXPECT_EQ(found.column[found.row[0]], 2);
  EXPECT_EQ(distance_to_nearest(X, 1, hidden)[0], 2);
  EXPECT_EQ(distance_to_nearest(X, 1)[0], 1);
  EXPECT_EQ(distance_to_nearest(X, 2, hidden)[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(distance_to_nearest(X, 2, hidden)[2], 2);
}

} // namespace
} // namespace tessera::preprocess
