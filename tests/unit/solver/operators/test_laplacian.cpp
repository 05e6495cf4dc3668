#include "solver/operators/laplacian.hpp"

#include "solver/operators/support.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// Largest error of the Laplacian of f over all particles, relative to f / spacing^2 at that size of field.
template <int D, class F>
double error(const ParticleCloud& cloud, const Neighbours& graph, F&& f, double expected) {
  const Laplacian laplacian = build_laplacian<D>(cloud.X, cloud.V, graph);
  double worst = 0;
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    double value = -laplacian.sum[a] * f(cloud.X[a]), scale = std::abs(expected);
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      value += laplacian.l[e] * f(cloud.X[graph.column[e]]);
      scale += std::abs(laplacian.l[e] * f(cloud.X[graph.column[e]]));
    }
    worst = std::max(worst, std::abs(value - expected) / scale);
  }
  return worst;
}

template <int D>
void exact(const ParticleCloud& cloud, const Neighbours& graph) {
  EXPECT_LT((error<D>(
                cloud, graph, [](const Vec3&) { return 1.0; }, 0)),
            1e-12);
  EXPECT_LT((error<D>(
                cloud, graph, [](const Vec3& x) { return x[0] - 2 * x[1] + 0.5 * x[2]; }, 0)),
            1e-12);
  EXPECT_LT((error<D>(
                cloud, graph, [](const Vec3& x) { return x.squaredNorm(); }, 2 * D)),
            1e-12);
}

} // namespace

TEST(Laplacian, IsExactOnLinearFieldsAndOnTheSquaredRadius) {
  const auto lattice = test::box_lattice(7, 6, 8, Vec3(1.2, 1, 1.4));
  exact<3>(lattice, uniform_support(lattice.X, 2.2 * lattice.spacing));
  const auto irregular = test::jittered(lattice, 0.3, 11);
  exact<3>(irregular, adaptive_support<3>(irregular.X, irregular.V, 30));
  const auto plane = test::jittered(test::box_lattice(9, 11, 1, Vec3(1, 1, 0)), 0.3, 3);
  exact<2>(plane, adaptive_support<2>(plane.X, plane.V, 14));
}

TEST(Laplacian, IsExactOnAnyQuadraticInsideALattice) {
  const auto lattice = test::box_lattice(9, 9, 9, Vec3(1, 1, 1));
  const Neighbours graph = uniform_support(lattice.X, 2.2 * lattice.spacing);
  const Laplacian laplacian = build_laplacian<3>(lattice.X, lattice.V, graph);
  const auto f = [&](std::int64_t a) {
    return 3 * lattice.X[a][0] * lattice.X[a][0] + lattice.X[a][1] * lattice.X[a][2];
  };
  const std::int64_t centre = 4 * 81 + 4 * 9 + 4;
  double value = -laplacian.sum[centre] * f(centre);
  for (std::int64_t e = graph.row[centre]; e < graph.row[centre + 1]; ++e)
    value += laplacian.l[e] * f(graph.column[e]);
  EXPECT_NEAR(value, 6, 1e-11);
}
