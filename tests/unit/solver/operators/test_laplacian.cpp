#include "solver/operators/laplacian.hpp"

#include "core/error.hpp"
#include "solver/operators/support.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// Largest error of the Laplacian of f over all particles, relative to f / spacing^2 at that size of field.
template <int D, class F>
double error(const ParticleCloud& cloud, const Neighbours& graph, const Laplacian& laplacian, F&& f,
             double expected) {
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
void exact(const ParticleCloud& cloud, const Neighbours& graph, const Kernel<D>& kernel) {
  const Laplacian laplacian = build_laplacian<D>(cloud.X, cloud.V, graph, kernel);
  const auto of = [&](auto&& f, double expected) { return error<D>(cloud, graph, laplacian, f, expected); };
  EXPECT_LT(of([](const Vec3&) { return 1.0; }, 0), 1e-12);
  EXPECT_LT(of([](const Vec3& x) { return x[0] - 2 * x[1] + 0.5 * x[2]; }, 0), 1e-12);
  EXPECT_LT(of([](const Vec3& x) { return x.squaredNorm(); }, 2 * D), 1e-12);
}

} // namespace

TEST(Laplacian, IsExactOnLinearFieldsAndOnTheSquaredRadiusWithEveryKernel) {
  const auto lattice = test::box_lattice(7, 6, 8, Vec3(1.2, 1, 1.4));
  const auto irregular = test::jittered(lattice, 0.3, 11);
  const auto square = test::box_lattice(9, 11, 1, Vec3(1, 1, 0)), plane = test::jittered(square, 0.3, 3);
  for (const std::string& name : kernel_names()) {
    SCOPED_TRACE(name);
    const Kernel<3> solid{kernel_named(name)};
    exact<3>(lattice, uniform_support(lattice.X, 2.2 * lattice.spacing), solid);
    exact<3>(irregular, adaptive_support<3>(irregular.X, irregular.V, 30, {}, solid), solid);
    const Kernel<2> flat{kernel_named(name)};
    exact<2>(square, uniform_support(square.X, 2.2 * square.spacing), flat);
    exact<2>(plane, adaptive_support<2>(plane.X, plane.V, 14, {}, flat), flat);
  }
}

TEST(Laplacian, SingularCorrectionNamesTheParticleWithEveryKernel) {
  // The three neighbours of a corner cannot determine four coefficients.
  const auto cloud = test::box_lattice(4, 4, 4, Vec3(1, 1, 1));
  for (const std::string& name : kernel_names())
    try {
      build_laplacian<3>(cloud.X, cloud.V, uniform_support(cloud.X, 1.1 * cloud.spacing),
                         {kernel_named(name)});
      FAIL() << name << " built";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("particle 0 at (0, 0, 0) m has 3 neighbours"), std::string::npos) << message;
      EXPECT_NE(message.find("raise solver.support"), std::string::npos);
    }
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
