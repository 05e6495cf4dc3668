#include "preprocess/seeding/poisson.hpp"

#include "core/parallel.hpp"
#include "preprocess/cloud/renumber.hpp"
#include "preprocess/voronoi/merge.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::preprocess {
namespace {

PoissonCloud fill(const TetBody& body, const CadTopology& cad, const PoissonRequest& request) {
  PoissonCloud cloud = poisson_points(body, cad, request, Progress::silent());
  return cloud;
}

double size_at(const PoissonRequest& request, const TetBody& body, const Vec3& x) {
  return request.size ? request.size(body.scaling.out(x)) : 1;
}

/// No two points nearer than the rules allow, whichever came first.
void expect_apart(const PoissonCloud& cloud, const TetBody& body, const CadTopology& cad,
                  const PoissonRequest& request) {
  const int dimension = body.domain->dimension;
  const double radius = cloud.radius / body.scaling.length;
  const auto& [X, place] = cloud.points;
  const DelaunayGraph graph = delaunay_graph(X);
  for (std::int64_t i = 0; i < cloud.points.size(); ++i)
    for (const std::int32_t j : graph.of(i))
      if (j < i) {
        const double owed = radius * size_at(request, body, X[i]) * claim(cad, dimension, place[j], place[i]);
        ASSERT_GE((X[i] - X[j]).norm(), owed * (1 - 1e-12)) << i << ' ' << j;
      }
}

/// The farthest any point of the body lies from a particle, in radii: some vertex of the cells.
double largest_hole(const PoissonCloud& cloud, const TetBody& body, const PoissonRequest& request) {
  const std::vector<Vec3> X = permuted(cloud.points.X, hilbert_order(cloud.points.X));
  const DelaunayGraph graph = delaunay_graph(X);
  const RestrictedVoronoi voronoi(body, X, graph);
  double largest = 0;
  std::int32_t at = 0;
  const PlacedPoints vertices = cell_vertices(voronoi);
  for (const Vec3& x : vertices.X) {
    at = voronoi.locate(x, at);
    largest = std::max(largest,
                       (x - X[at]).norm() * body.scaling.length / cloud.radius / size_at(request, body, x));
  }
  return largest;
}

TEST(Poisson, PointsKeepTheirDistanceAndLeaveNoHole) {
  for (const Domain& domain : {test::box_domain(), test::l_domain(2, 1e-3), test::square_slab(1),
                               test::l_slab(2, 50), test::holed_slab(4)})
    for (const std::int64_t count : {300, 2000}) {
      const CadTopology cad(domain);
      const double h = std::pow(domain.volume / static_cast<double>(count), 1. / domain.dimension);
      const TetBody body(domain, scaling_for(domain, h));
      const PoissonRequest request{count, 1, {}};
      const PoissonCloud cloud = fill(body, cad, request);
      EXPECT_NEAR(static_cast<double>(cloud.points.size()), static_cast<double>(count),
                  0.02 * static_cast<double>(count));
      expect_apart(cloud, body, cad, request);
      EXPECT_LE(largest_hole(cloud, body, request), 1.1);
      EXPECT_GE(cloud.radius, 0.8 * h);
      std::array<std::int64_t, 4> of_dimension{};
      for (const CadPlace& place : cloud.points.place)
        ++of_dimension[place.dimension];
      EXPECT_EQ(of_dimension[0], static_cast<std::int64_t>(domain.corners.size()));
      for (int d = 1; d <= domain.dimension; ++d)
        EXPECT_GT(of_dimension[d], 0);
    }
}

TEST(Poisson, FollowsASizeField) {
  for (const Domain& domain : {test::l_domain(1), test::l_slab(1)}) {
    const CadTopology cad(domain);
    const Vec3 middle(0.3, 0.5, domain.dimension == 3 ? 0.5 : 0);
    const PoissonRequest request{2500, 3, size_field(domain, {{middle, 0.25, 0.1, 0.7}}, false)};
    const double h = std::pow(graded_volume(domain, request.size) / 2500, 1. / domain.dimension);
    const TetBody body(domain, scaling_for(domain, h));
    const PoissonCloud cloud = fill(body, cad, request);
    EXPECT_NEAR(static_cast<double>(cloud.points.size()), 2500, 50);
    expect_apart(cloud, body, cad, request);
    EXPECT_LE(largest_hole(cloud, body, request), 1.15);
  }
}

TEST(Poisson, SameSeedSameBitsOnAnyThreadCount) {
  const Domain ell = test::l_domain(2);
  const CadTopology cad(ell);
  const TetBody body(ell, scaling_for(ell, 0.1));
  const auto cloud_with = [&](int threads, std::uint64_t seed) {
    set_threads(threads);
    PoissonCloud cloud = fill(body, cad, {2000, seed, {}});
    set_threads(0);
    return cloud.points.X;
  };
  const auto one = cloud_with(1, 5);
  EXPECT_EQ(one, cloud_with(3, 5));
  EXPECT_NE(one, cloud_with(1, 6));
}

} // namespace
} // namespace tessera::preprocess
