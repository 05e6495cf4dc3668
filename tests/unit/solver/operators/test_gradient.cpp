#include "solver/operators/gradient.hpp"

#include "core/error.hpp"
#include "solver/operators/support.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace tessera;
using namespace tessera::solver;

namespace {

struct Clouds {
  ParticleCloud cloud;
  Neighbours graph;
};

std::vector<Clouds> solid_clouds(const Kernel<3>& kernel = {}) {
  std::vector<Clouds> list;
  const auto lattice = test::box_lattice(7, 6, 8, Vec3(1.2, 1, 1.4));
  list.push_back({lattice, uniform_support(lattice.X, 2.2 * lattice.spacing)});
  const auto irregular = test::jittered(lattice, 0.3, 11);
  list.push_back({irregular, adaptive_support<3>(irregular.X, irregular.V, 30, {}, kernel)});
  // The same in micrometres: weights must not depend on the unit.
  auto small = irregular;
  for (Vec3& x : small.X)
    x *= 1e-6;
  for (double& v : small.V)
    v *= 1e-18;
  small.spacing *= 1e-6;
  list.push_back({small, adaptive_support<3>(small.X, small.V, 30, {}, kernel)});
  return list;
}

template <int D>
void exact_on_linear(const ParticleCloud& cloud, const Neighbours& graph, const Kernel<D>& kernel) {
  const auto gradient = build_gradient<D>(cloud.X, cloud.V, graph, kernel);
  Mat<D> slope;
  for (int i = 0; i < D * D; ++i)
    slope.data()[i] = 0.3 * i - 0.8;
  const auto f = [&](std::int64_t a) -> Vec<D> {
    return slope * cloud.X[a].template head<D>() + Vec<D>::Constant(0.25);
  };
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    Mat<D> G = Mat<D>::Zero();
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      const std::int32_t b = graph.column[e];
      G += (f(b) - f(a)) * gradient.w(a, e, b).transpose();
    }
    // The sums hold terms of the size of f / spacing: round-off is relative to that.
    const double scale = slope.norm() + 0.5 / cloud.spacing;
    ASSERT_LT((G - slope).norm() / scale, 1e-12) << a;
  }
}

} // namespace

TEST(Gradient, IsExactOnLinearFieldsWithEveryKernel) {
  const auto lattice = test::box_lattice(9, 11, 1, Vec3(1, 1, 0));
  const auto plane = test::jittered(lattice, 0.3, 3);
  for (const std::string& name : kernel_names()) {
    SCOPED_TRACE(name);
    const Kernel<3> solid{kernel_named(name)};
    for (const auto& [cloud, graph] : solid_clouds(solid))
      exact_on_linear<3>(cloud, graph, solid);
    const Kernel<2> flat{kernel_named(name)};
    exact_on_linear<2>(lattice, uniform_support(lattice.X, 2.2 * lattice.spacing), flat);
    exact_on_linear<2>(plane, adaptive_support<2>(plane.X, plane.V, 12, {}, flat), flat);
  }
}

TEST(Gradient, DivergenceIsMinusItsWeightedTranspose) {
  for (const auto& [cloud, graph] : solid_clouds()) {
    const auto gradient = build_gradient<3>(cloud.X, cloud.V, graph);
    std::mt19937_64 random(5);
    const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
    std::vector<Vec3> v(cloud.X.size());
    std::vector<Mat3> P(cloud.X.size());
    for (auto& u : v)
      u = Vec3(number(), number(), number());
    for (auto& Q : P)
      for (int i = 0; i < 9; ++i)
        Q.data()[i] = number();
    double power_of_forces = 0, power_of_stresses = 0;
    for (std::int64_t a = 0; a < graph.size(); ++a) {
      Mat3 G = Mat3::Zero();
      Vec3 T = Vec3::Zero();
      for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
        const std::int32_t b = graph.column[e];
        G += (v[b] - v[a]) * gradient.w(a, e, b).transpose();
        T += P[a] * gradient.w(a, e, b) + P[b] * gradient.t(a, e, b);
      }
      power_of_forces += cloud.V[a] * v[a].dot(T);
      power_of_stresses += cloud.V[a] * (P[a].array() * G.array()).sum();
    }
    EXPECT_NEAR(power_of_forces / power_of_stresses, -1, 1e-12);
  }
}

TEST(Gradient, ForcesOfAnyStressSumToZero) {
  for (const auto& [cloud, graph] : solid_clouds()) {
    const auto gradient = build_gradient<3>(cloud.X, cloud.V, graph);
    Vec3 total = Vec3::Zero();
    double scale = 0;
    for (std::int64_t a = 0; a < graph.size(); ++a) {
      const auto stress = [&](std::int64_t b) {
        return Mat3(Mat3::Identity() * std::sin(static_cast<double>(b)));
      };
      Vec3 T = Vec3::Zero();
      for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
        const std::int32_t b = graph.column[e];
        T += stress(a) * gradient.w(a, e, b) + stress(b) * gradient.t(a, e, b);
      }
      total += cloud.V[a] * T;
      scale += cloud.V[a] * T.norm();
    }
    EXPECT_LT(total.norm() / scale, 1e-12);
  }
}

TEST(Gradient, TooSmallASupportNamesTheParticleAndItsNeighboursWithEveryKernel) {
  const auto cloud = test::box_lattice(4, 4, 4, Vec3(1, 1, 1));
  for (const std::string& name : kernel_names())
    try {
      build_gradient<3>(cloud.X, cloud.V, uniform_support(cloud.X, 0.9 * cloud.spacing),
                        {kernel_named(name)});
      FAIL() << name << " built";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("particle 0 at (0, 0, 0) m has 0 neighbours"), std::string::npos) << message;
      EXPECT_NE(message.find("raise solver.support"), std::string::npos);
    }
}
