#include "preprocess/voronoi/relax.hpp"

#include "core/parallel.hpp"
#include "preprocess/seeding/random.hpp"
#include "preprocess/seeding/tet_locator.hpp"
#include "preprocess/voronoi/two_pass.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::preprocess {
namespace {

struct Case {
  Domain domain;
  CadTopology cad;
  TetBody body;

  Case(const Domain& from, std::int64_t count, const SizeField& size = {})
      : domain(from), cad(domain),
        body(domain, scaling_for(domain, std::pow(graded_volume(domain, size) / static_cast<double>(count),
                                                  1. / domain.dimension))) {}

  PlacedPoints two_pass(std::int64_t count, const SizeField& size = {}) const {
    return two_pass_points(body, cad, {count, 0.5, 1, size, 0}, Progress::silent()).points;
  }
  /// (volume / points)^(1/d), scaled.
  double h(std::size_t points) const {
    return std::pow(domain.volume / static_cast<double>(points), 1. / domain.dimension) / body.scaling.length;
  }
};

double least_distance(const std::vector<Vec3>& X) {
  const DelaunayGraph graph = delaunay_graph(X);
  double least = 1e300;
  for (std::size_t i = 0; i < X.size(); ++i)
    least = std::min(least, (X[graph.of(static_cast<std::int64_t>(i))[0]] - X[i]).norm());
  return least;
}

/// Every particle still lies on its corner, curve or surface, or inside the body.
void expect_in_place(const Case& c, const PlacedPoints& particles) {
  const TetLocator locator(c.domain, c.body.points);
  for (std::int64_t i = 0; i < particles.size(); ++i) {
    const Vec3& x = particles.X[i];
    const CadPlace& place = particles.place[i];
    if (place.dimension == 0) {
      Vec3 corner = c.body.points[place.entity];
      corner.z() = c.domain.dimension == 2 ? 0 : corner.z();
      ASSERT_EQ(x, corner);
    } else if (place.dimension == c.domain.dimension) {
      ASSERT_GE(locator.locate(x), 0) << x.transpose();
    } else {
      // Plane faces here: the particle is in the planes of its surfaces.
      for (const auto& facet : c.domain.facets)
        for (const std::int32_t s : c.cad.surfaces_of(place))
          if (facet.surface == s) {
            const Vec3& a = c.body.points[facet.vertices[0]];
            const Vec3 normal = (c.body.points[facet.vertices[1]] - a)
                                    .cross(c.body.points[facet.vertices[2]] - a)
                                    .normalized();
            ASSERT_NEAR(normal.dot(x - a), 0, 1e-12);
          }
    }
  }
}

TEST(Relax, SpreadsTheParticles) {
  for (const Domain& domain : {test::l_domain(2, 1e-3), test::l_slab(2, 1e3)}) {
    const Case c(domain, 1200);
    const PlacedPoints before = c.two_pass(1200);
    const PlacedPoints after = relaxed(c.body, c.cad, before, {}, 45, Progress::silent());
    ASSERT_EQ(after.size(), before.size());
    expect_in_place(c, after);
    EXPECT_LE(least_distance(before.X), 0.45 * c.h(before.X.size()));
    EXPECT_GE(least_distance(after.X), 0.7 * c.h(after.X.size()));
  }
}

TEST(Relax, SpreadsAlongClosedCurvesToo) {
  const Case c(test::holed_slab(6), 1000);
  const PlacedPoints after = relaxed(c.body, c.cad, c.two_pass(1000), {}, 30, Progress::silent());
  EXPECT_GE(least_distance(after.X), 0.7 * c.h(after.X.size()));
  // Of the rim of the hole, a polygon of 48 corners: equal steps along it.
  std::vector<double> angles;
  for (std::int64_t i = 0; i < after.size(); ++i) {
    const Vec3 from_middle = c.body.scaling.out(after.X[i]) - Vec3(0.5, 0.5, 0);
    if (after.place[i].dimension == 1 && from_middle.norm() < 0.4) {
      EXPECT_LE(from_middle.norm(), 0.3 + 1e-12);
      EXPECT_GE(from_middle.norm(), 0.3 * std::cos(std::numbers::pi / 48) - 1e-12);
      angles.push_back(std::atan2(from_middle.y(), from_middle.x()));
    }
  }
  std::sort(angles.begin(), angles.end());
  ASSERT_GT(angles.size(), 20u);
  for (std::size_t k = 1; k < angles.size(); ++k)
    EXPECT_NEAR(angles[k] - angles[k - 1], 2 * std::numbers::pi / static_cast<double>(angles.size()), 0.003);
}

TEST(Relax, FollowsASizeField) {
  for (const Domain& domain : {test::l_domain(1), test::l_slab(1)}) {
    const Vec3 middle(0.3, 0.5, domain.dimension == 3 ? 0.5 : 0);
    const SizeField size = size_field(domain, {{middle, 0.3, 0.15, 0.8}}, false);
    const Case c(domain, 1500, size);
    const PlacedPoints after = relaxed(c.body, c.cad, c.two_pass(1500, size), size, 20, Progress::silent());
    expect_in_place(c, after);
    const double h =
        std::pow(graded_volume(domain, size) / static_cast<double>(after.size()), 1. / domain.dimension);
    const DelaunayGraph graph = delaunay_graph(after.X);
    double least = 1, fine = 0, coarse = 0;
    int in_fine = 0, in_coarse = 0;
    for (std::int64_t i = 0; i < after.size(); ++i) {
      const double apart = (after.X[graph.of(i)[0]] - after.X[i]).norm() * c.body.scaling.length / h;
      const double here = size(c.body.scaling.out(after.X[i]));
      least = std::min(least, apart / here);
      if (here == 0.3) {
        fine += apart;
        ++in_fine;
      } else if (here == 1) {
        coarse += apart;
        ++in_coarse;
      }
    }
    EXPECT_GE(least, 0.6);
    EXPECT_NEAR(fine / in_fine / (coarse / in_coarse), 0.3, 0.03);
  }
}

TEST(Relax, SlotsAreNeverCrossed) {
  // A slot a tenth of the spacing wide: cells own material across it.
  const Case c(test::slotted_slab(4, 0.004), 1200);
  const PlacedPoints before = c.two_pass(1200);
  const PlacedPoints after = relaxed(c.body, c.cad, before, {}, 30, Progress::silent());
  const auto side = [&](const Vec3& x) {
    const Vec3 X = c.body.scaling.out(x);
    return X.y() < 0 ? 0 : X.x() < 1.002 ? -1 : 1;
  };
  expect_in_place(c, after);
  double least = 1e300;
  for (std::int64_t i = 0; i < after.size(); ++i) {
    EXPECT_NE(side(before.X[i]) * side(after.X[i]), -1);
    for (std::int64_t j = 0; j < i; ++j)
      if (side(after.X[i]) * side(after.X[j]) != -1)
        least = std::min(least, (after.X[i] - after.X[j]).norm());
  }
  EXPECT_GE(least, 0.6 * c.h(after.X.size()));
}

TEST(Relax, SeedsSpreadWithoutLeavingTheBody) {
  for (const Domain& domain : {test::l_domain(2), test::slotted_slab(3, 0.01)}) {
    const Case c(domain, 3000);
    RandomPoints random(domain, 4);
    std::vector<Vec3> seeds;
    for (int i = 0; i < 3000; ++i)
      seeds.push_back(c.body.scaling.in(random.next()));
    const auto after = relaxed_seeds(c.body, c.cad, seeds, {}, 12, Progress::silent());
    const TetLocator locator(c.domain, c.body.points);
    for (const Vec3& x : after)
      ASSERT_GE(locator.locate(x), 0);
    if (domain.dimension == 3) {
      EXPECT_GE(least_distance(after), 0.6 * c.h(after.size()));
    }
  }
}

TEST(Relax, SameBitsOnAnyThreadCount) {
  const Case c(test::l_domain(2), 1500);
  const PlacedPoints before = c.two_pass(1500);
  const auto with = [&](int threads) {
    set_threads(threads);
    const PlacedPoints after = relaxed(c.body, c.cad, before, {}, 3, Progress::silent());
    set_threads(0);
    return after.X;
  };
  EXPECT_EQ(with(1), with(3));
  EXPECT_EQ(relaxed(c.body, c.cad, before, {}, 0, Progress::silent()).X, before.X);
}

} // namespace
} // namespace tessera::preprocess
