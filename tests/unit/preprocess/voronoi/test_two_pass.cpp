#include "preprocess/voronoi/two_pass.hpp"

#include "preprocess/seeding/random.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

TEST(KeptPoints, AnswersAsABruteForceSearchDoes) {
  // Radii over two decades: several grids.
  const Domain box = test::box_domain();
  const CadTopology cad(box);
  RandomNumbers numbers(11);
  const auto radius_at = [](const Vec3& x) { return 0.003 + 0.3 * x.x() * x.x(); };
  KeptPoints kept(cad, 3, 0.003, 0.303);
  PlacedPoints all;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x(numbers.next(), numbers.next(), numbers.next());
    const auto too_near = [&](const Vec3& y) { return (x - y).norm() < radius_at(x); };
    const bool expected = std::none_of(all.X.begin(), all.X.end(), too_near);
    ASSERT_EQ(kept.has_room(x, {}, radius_at(x)), expected);
    if (expected) {
      kept.add(x, {});
      all.add(x, {});
    }
    std::vector<std::int32_t> found;
    kept.collect(x, 0.1, found);
    ASSERT_EQ(static_cast<std::int64_t>(found.size()),
              std::count_if(all.X.begin(), all.X.end(), [&](const Vec3& y) { return (x - y).norm() < 0.1; }));
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
  }
}

TEST(TwoPass, MeetsTheCountInSpaceAndInThePlane) {
  for (const Domain& domain : {test::l_domain(2), test::l_slab(2, 1e-3), test::holed_slab(4, 1e3)})
    for (const double merge : {0.3, 0.5}) {
      const CadTopology cad(domain);
      const double h = std::pow(domain.volume / 3000, 1. / domain.dimension);
      const TetBody body(domain, scaling_for(domain, h));
      const TwoPass cloud = two_pass_points(body, cad, {3000, merge, 1, {}, 0}, Progress::silent());
      EXPECT_NEAR(static_cast<double>(cloud.points.size()), 3000, 60);
      std::int64_t corners = 0;
      for (std::int64_t i = 0; i < cloud.points.size(); ++i) {
        corners += cloud.points.place[i].dimension == 0;
        ASSERT_TRUE(domain.dimension == 3 || cloud.points.X[i].z() == 0);
      }
      EXPECT_EQ(corners, static_cast<std::int64_t>(domain.corners.size()));
      // Two vertices a seed in the plane, some more along the walls.
      if (domain.dimension == 2) {
        const double vertices = domain.volume / (cloud.h * cloud.h);
        EXPECT_NEAR(vertices / static_cast<double>(cloud.seeds), 2.05, 0.1);
      }
    }
}

TEST(TwoPass, GradedCloudKeepsItsDistanceEverywhere) {
  for (const Domain& domain : {test::l_domain(1), test::l_slab(1)}) {
    const CadTopology cad(domain);
    const int d = domain.dimension;
    const Vec3 middle(0.3, 0.5, d == 3 ? 0.5 : 0);
    const SizeField size = size_field(domain, {{middle, 0.25, 0.15, 0.7}}, false);
    const TetBody body(domain, scaling_for(domain, std::pow(graded_volume(domain, size) / 4000, 1. / d)));
    const TwoPass cloud = two_pass_points(body, cad, {4000, 0.5, 1, size, 0}, Progress::silent());
    EXPECT_NEAR(static_cast<double>(cloud.points.size()), 4000, 80);
    const DelaunayGraph graph = delaunay_graph(cloud.points.X);
    double fine = 0, coarse = 0, least = 1;
    int in_fine = 0, in_coarse = 0;
    for (std::int64_t i = 0; i < cloud.points.size(); ++i) {
      const Vec3 X = body.scaling.out(cloud.points.X[i]);
      const double apart =
          (cloud.points.X[graph.of(i)[0]] - cloud.points.X[i]).norm() * body.scaling.length / cloud.h;
      const Vec3 other = body.scaling.out(cloud.points.X[graph.of(i)[0]]);
      least = std::min(least, apart / std::min(size(X), size(other)));
      if (size(X) == 0.25) {
        fine += apart;
        ++in_fine;
      } else if (size(X) == 1) {
        coarse += apart;
        ++in_coarse;
      }
    }
    EXPECT_GE(least, 0.39);
    // Near the boundary, which only coarse particles are, nearest neighbours are a little farther away.
    EXPECT_NEAR(fine / in_fine / (coarse / in_coarse), 0.25, 0.03);
  }
}

} // namespace
} // namespace tessera::preprocess
