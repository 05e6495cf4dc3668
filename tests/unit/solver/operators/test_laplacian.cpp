#include "solver/operators/laplacian.hpp"

#include "core/error.hpp"
#include "solver/operators/support.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

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

TEST(Laplacian, IsExactOnWhatTheNeighboursTellApart) {
  // Within supports of two spacings a corner and its neighbours lie on a sphere: |X|^2 is linear there. On
  // faces and edges it is not, and all stays exact.
  const auto lattice = test::box_lattice(5, 6, 4, Vec3(1.2, 1.5, 0.9));
  const auto plane = test::box_lattice(7, 5, 1, Vec3(1.2, 0.8, 0));
  const auto look = [](auto dimension, const ParticleCloud& cloud, double support, const std::string& kernel,
                       std::int64_t corners) {
    constexpr int D = decltype(dimension)::value;
    const Neighbours graph = uniform_support(cloud.X, support * cloud.spacing);
    const Laplacian laplacian = build_laplacian<D>(cloud.X, cloud.V, graph, Kernel<D>{kernel_named(kernel)});
    EXPECT_EQ(laplacian.blind, corners);
    double scale = 0;
    for (const double l : laplacian.l)
      scale = std::max(scale, std::abs(l));
    std::int64_t without = 0;
    for (std::int64_t a = 0; a < graph.size(); ++a) {
      Vec3 slope = Vec3::Zero();
      double square = 0, size = 0;
      for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
        const Vec3 R = cloud.X[graph.column[e]] - cloud.X[a];
        slope += laplacian.l[e] * R;
        square += laplacian.l[e] * R.squaredNorm();
        size = std::max(size, std::abs(laplacian.l[e]));
      }
      EXPECT_LT(slope.norm(), 1e-12 * scale * cloud.spacing) << a;
      if (size == 0)
        ++without;
      else
        EXPECT_NEAR(square, 2 * D, 1e-11) << a;
    }
    EXPECT_EQ(without, corners);
  };
  for (const std::string& kernel : kernel_names())
    for (const double support : {1.2, 1.5, 1.8, 1.99}) {
      SCOPED_TRACE(testing::Message() << kernel << ", support " << support);
      look(std::integral_constant<int, 3>{}, lattice, support, kernel, 8);
      look(std::integral_constant<int, 2>{}, plane, support, kernel, 4);
    }
  look(std::integral_constant<int, 3>{}, lattice, 2.2, "wendland", 0);
}

TEST(Laplacian, NeighboursThatDoNotSpanSpaceAreNamedWithEveryKernel) {
  auto cloud = test::box_lattice(4, 4, 4, Vec3(1, 1, 1));
  cloud.X[0] = Vec3(-0.2, 0, 0); // two neighbours in reach
  for (const std::string& name : kernel_names())
    try {
      build_laplacian<3>(cloud.X, cloud.V, uniform_support(cloud.X, 1.2 * cloud.spacing),
                         {kernel_named(name)});
      FAIL() << name << " built";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("particle 0 at (-0.2, 0, 0) m has 2 neighbours"), std::string::npos) << message;
      EXPECT_NE(message.find("raise solver.support"), std::string::npos);
    }
}

TEST(Laplacian, TransposeIsThatOfTheFormWithVolumes) {
  const auto cloud = test::jittered(test::box_lattice(5, 6, 5, Vec3(0.8, 1, 0.8)), 0.3, 2);
  const Neighbours graph = adaptive_support<3>(cloud.X, cloud.V, 30);
  const Laplacian laplacian = build_laplacian<3>(cloud.X, cloud.V, graph);
  const std::vector<double> transpose = transposed(laplacian, cloud.V, graph);
  const auto apply = [&](const std::vector<double>& weights, auto&& f, std::int64_t a) {
    double value = -laplacian.sum[a] * f(a);
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e)
      value += weights[e] * f(graph.column[e]);
    return value;
  };
  const auto f = [&](std::int64_t a) { return std::sin(5 * cloud.X[a][0] + 3 * cloud.X[a][1]); };
  const auto g = [&](std::int64_t a) { return std::cos(7 * cloud.X[a][2] - 2 * cloud.X[a][1]); };
  double one = 0, other = 0;
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    one += cloud.V[a] * g(a) * apply(laplacian.l, f, a);
    other += cloud.V[a] * f(a) * apply(transpose, g, a);
  }
  EXPECT_NEAR(one / other, 1, 1e-12);
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
