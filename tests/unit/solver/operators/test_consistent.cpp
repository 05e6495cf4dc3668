#include "solver/operators/consistent.hpp"

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

struct Case {
  ParticleCloud cloud;
  Neighbours graph;
};

template <int D>
std::vector<Case> cases() {
  const ParticleCloud lattice = D == 3 ? test::box_lattice(8, 7, 9, Vec3(1.4, 1.2, 1.6))
                                       : test::box_lattice(12, 15, 1, Vec3(1.1, 1.4, 0));
  const ParticleCloud irregular = test::jittered(lattice, 0.3, 5);
  ParticleCloud small = irregular; // in micrometres
  small.spacing *= 1e-6;
  for (std::size_t a = 0; a < small.X.size(); ++a) {
    small.X[a] *= 1e-6;
    small.V[a] *= std::pow(1e-6, D);
    small.A[a] *= std::pow(1e-6, D - 1);
  }
  ParticleCloud even = lattice; // the volume shared alike
  even.V.assign(even.X.size(), even.domain_volume / static_cast<double>(even.X.size()));
  const int few = D == 3 ? 30 : 14;
  return {{lattice, uniform_support(lattice.X, 2.2 * lattice.spacing)},
          {irregular, adaptive_support<D>(irregular.X, irregular.V, few)},
          {small, adaptive_support<D>(small.X, small.V, few)},
          {even, uniform_support(even.X, 2.2 * even.spacing)}};
}

template <int D>
Gradient<D> balanced(const Case& c) {
  Gradient<D> gradient = build_gradient<D>(c.cloud.X, c.cloud.V, c.graph);
  balance_constant_stress<D>(gradient, c.cloud.X, c.cloud.A, c.graph);
  return gradient;
}

template <class T>
class Consistent : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Consistent, Dimensions);

} // namespace

TYPED_TEST(Consistent, GradientStaysExactOnLinearFields) {
  constexpr int D = TypeParam::value;
  for (const auto& c : cases<D>()) {
    const Gradient<D> gradient = balanced<D>(c);
    Mat<D> slope;
    for (int i = 0; i < D * D; ++i)
      slope.data()[i] = 0.3 * i - 0.8;
    const Vec3 middle = c.cloud.X[c.cloud.X.size() / 2];
    const double scale = slope.norm() * (c.cloud.X.front() - c.cloud.X.back()).norm() / c.cloud.spacing;
    const auto f = [&](std::int64_t a) -> Vec<D> {
      return slope * (c.cloud.X[a] - middle).template head<D>();
    };
    for (std::int64_t a = 0; a < c.graph.size(); ++a) {
      Mat<D> G = Mat<D>::Zero();
      for (std::int64_t e = c.graph.row[a]; e < c.graph.row[a + 1]; ++e) {
        const std::int32_t b = c.graph.column[e];
        G += (f(b) - f(a)) * gradient.w(a, e, b).transpose();
      }
      ASSERT_LT((G - slope).norm() / scale, 1e-12) << a;
    }
  }
}

TYPED_TEST(Consistent, ConstantStressIsBalancedByItsTractionInEveryParticle) {
  constexpr int D = TypeParam::value;
  for (const auto& c : cases<D>()) {
    const Gradient<D> gradient = balanced<D>(c);
    Mat<D> P;
    for (int i = 0; i < D * D; ++i)
      P.data()[i] = 1e6 * (i - 0.7);
    double largest = 0;
    for (const Vec3& A : c.cloud.A)
      largest = std::max(largest, A.norm());
    for (std::int64_t a = 0; a < c.graph.size(); ++a) {
      Vec<D> T = Vec<D>::Zero();
      for (std::int64_t e = c.graph.row[a]; e < c.graph.row[a + 1]; ++e) {
        const std::int32_t b = c.graph.column[e];
        T += P * (gradient.w(a, e, b) + gradient.t(a, e, b));
      }
      const Vec<D> traction = P * c.cloud.A[a].template head<D>();
      ASSERT_LT((c.cloud.V[a] * T + traction).norm(), 1e-12 * largest * P.norm()) << a;
    }
  }
}

TYPED_TEST(Consistent, DivergenceStaysMinusTheWeightedTransposeOfTheGradient) {
  constexpr int D = TypeParam::value;
  for (const auto& c : cases<D>()) {
    const Gradient<D> gradient = balanced<D>(c);
    double worst = 0, largest = 0;
    for (std::int64_t a = 0; a < c.graph.size(); ++a)
      for (std::int64_t e = c.graph.row[a]; e < c.graph.row[a + 1]; ++e) {
        const std::int32_t b = c.graph.column[e];
        const auto first = c.graph.column.begin() + c.graph.row[b];
        const auto last = c.graph.column.begin() + c.graph.row[b + 1];
        const auto back =
            std::lower_bound(first, last, static_cast<std::int32_t>(a)) - c.graph.column.begin();
        // t_ab = -V_b g_ba and w_ba = V_a g_ba
        const Vec<D> t = gradient.t(a, e, b), w = gradient.w(b, back, static_cast<std::int32_t>(a));
        worst = std::max(worst, (c.cloud.V[a] * t + c.cloud.V[b] * w).norm());
        largest = std::max(largest, c.cloud.V[a] * t.norm());
      }
    EXPECT_LT(worst, 1e-14 * largest);
  }
}

TYPED_TEST(Consistent, CorrectionIsNoneWhereNothingIsLacking) {
  // Deep inside a lattice the corrected kernel gradient balances a constant stress by symmetry: what the
  // surface wants must not reach far.
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = D == 3 ? test::box_lattice(13, 13, 13, Vec3(1.2, 1.2, 1.2))
                                     : test::box_lattice(25, 25, 1, Vec3(2.4, 2.4, 0));
  const Neighbours graph = uniform_support(cloud.X, 2.2 * cloud.spacing);
  const Gradient<D> before = build_gradient<D>(cloud.X, cloud.V, graph);
  Gradient<D> after = before;
  balance_constant_stress<D>(after, cloud.X, cloud.A, graph);
  const auto middle = static_cast<std::int64_t>(cloud.X.size() / 2);
  double change = 0, surface = 0, scale = 0;
  for (std::int64_t e = graph.row[middle]; e < graph.row[middle + 1]; ++e) {
    const std::int32_t b = graph.column[e];
    change = std::max(change, (after.w(middle, e, b) - before.w(middle, e, b)).norm());
    scale = std::max(scale, before.w(middle, e, b).norm());
  }
  for (std::int64_t e = graph.row[0]; e < graph.row[1]; ++e)
    surface = std::max(surface, (after.w(0, e, graph.column[e]) - before.w(0, e, graph.column[e])).norm());
  EXPECT_GT(surface, 0.05 * scale);
  EXPECT_LT(change, 0.01 * scale);
}

TYPED_TEST(Consistent, RefusesACloudWhoseAreasAreNotBalanced) {
  constexpr int D = TypeParam::value;
  auto c = cases<D>()[0];
  c.cloud.A[0] *= 1.001;
  try {
    balanced<D>(c);
    FAIL() << "balanced " << D;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("do not balance a constant stress"), std::string::npos) << message;
    EXPECT_NE(message.find("choose solver.scheme"), std::string::npos);
  }
}
