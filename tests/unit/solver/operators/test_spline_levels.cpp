#include "solver/operators/spline_levels.hpp"

#include "core/parallel.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/operators/support.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

struct Case {
  ParticleCloud cloud;
  Neighbours graph;

  template <int D>
  Gradient<D> gradient() const {
    return build_gradient<D>(cloud.X, cloud.V, graph);
  }
};

template <int D>
std::vector<Case> cases() {
  ParticleCloud lattice = D == 3 ? test::box_lattice(9, 7, 8, Vec3(1.6, 1.2, 1.4))
                                 : test::box_lattice(18, 15, 1, Vec3(1.7, 1.4, 0));
  Neighbours near = uniform_support(lattice.X, 1.6 * lattice.spacing);
  ParticleCloud irregular = test::jittered(lattice, 0.3, 5);
  Neighbours adapted = adaptive_support<D>(irregular.X, irregular.V, D == 3 ? 30 : 14);
  return {{std::move(lattice), std::move(near)}, {std::move(irregular), std::move(adapted)}};
}

/// Numbers between -1 and 1 without order in them.
template <int D>
Field<D> rough(std::int64_t n, double phase) {
  Field<D> field = Field<D>::Zero(Field<D>::RowsAtCompileTime, n);
  for (std::int64_t a = 0; a < n; ++a)
    for (int c = 0; c < D; ++c)
      field(c, a) = std::sin(phase + 12.9898 * double(a * a % 9973) + 78.233 * c);
  return field;
}

template <int D>
Field<D> times(FitResidual<D>& K, const Field<D>& x) {
  Field<D> y(x.rows(), x.cols());
  K.multiply(x, y);
  return y;
}

template <int D>
Field<D> times(SplineLevels<D>& B, const Field<D>& x) {
  Field<D> y(x.rows(), x.cols());
  B.apply(x, y);
  return y;
}

/// A box of spacings that grow by `ratio` from the corner along every axis, n along each: its Voronoi
/// subvolumes and areas.
ParticleCloud graded(int n, double ratio) {
  std::vector<double> x(1, 0.0), width;
  for (int i = 1; i < n; ++i)
    x.push_back(x.back() + std::pow(ratio, i));
  for (int i = 0; i < n; ++i)
    width.push_back((x[std::min(i + 1, n - 1)] - x[std::max(i - 1, 0)]) / 2);
  const auto outward = [&](int i) { return double(i == n - 1) - double(i == 0); };
  ParticleCloud cloud;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        cloud.X.emplace_back(x[i], x[j], x[k]);
        cloud.V.push_back(width[i] * width[j] * width[k]);
        cloud.A.emplace_back(outward(i) * width[j] * width[k], outward(j) * width[i] * width[k],
                             outward(k) * width[i] * width[j]);
      }
  return cloud;
}

std::int64_t iterations(const ParticleCloud& cloud, const Neighbours& graph) {
  Gradient<3> gradient = build_gradient<3>(cloud.X, cloud.V, graph);
  return balance_constant_stress<3>(gradient, cloud.X, cloud.A, graph);
}

template <class T>
class SplineLevelsOf : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SplineLevelsOf, Dimensions);

} // namespace

TYPED_TEST(SplineLevelsOf, FitResidualIsSymmetricAndHasItsDiagonal) {
  constexpr int D = TypeParam::value;
  for (const Case& c : cases<D>()) {
    const Gradient<D> gradient = c.template gradient<D>();
    FitResidual<D> K(c.cloud.X, c.graph, gradient);
    const std::int64_t n = K.particles();
    const Field<D> x = rough<D>(n, 0.3), y = rough<D>(n, 1.1);
    const double x_Ky = x.cwiseProduct(times(K, y)).sum(), y_Kx = y.cwiseProduct(times(K, x)).sum();
    const double x_Kx = x.cwiseProduct(times(K, x)).sum();
    EXPECT_GT(x_Kx, 0);
    EXPECT_NEAR(x_Ky, y_Kx, 1e-13 * x_Kx);
    const std::vector<double> diagonal = K.diagonal();
    for (const std::int64_t a : {std::int64_t(0), n / 3, n / 2, n - 1}) {
      Field<D> unit = Field<D>::Zero(Field<D>::RowsAtCompileTime, n);
      unit(D - 1, a) = 1;
      const Field<D> column = times(K, unit);
      EXPECT_NEAR(column(D - 1, a), diagonal[a], 1e-13 * diagonal[a]);
      EXPECT_EQ(column.topRows(D - 1).cwiseAbs().maxCoeff(), 0); // components do not see each other
    }
  }
}

TYPED_TEST(SplineLevelsOf, FitLeavesNothingOfLinearFields) {
  constexpr int D = TypeParam::value;
  for (const Case& c : cases<D>()) {
    const Gradient<D> gradient = c.template gradient<D>();
    FitResidual<D> K(c.cloud.X, c.graph, gradient);
    Field<D> linear = Field<D>::Zero(Field<D>::RowsAtCompileTime, K.particles());
    for (std::int64_t a = 0; a < K.particles(); ++a)
      for (int i = 0; i < D; ++i)
        linear(i, a) = 0.4 - i + c.cloud.X[a].head<D>().dot(Vec<D>::LinSpaced(-0.7, 0.9 + i));
    const Field<D> rest = rough<D>(K.particles(), 0.2);
    EXPECT_LT(times(K, linear).cwiseAbs().maxCoeff(), 1e-13 * times(K, rest).cwiseAbs().maxCoeff());
  }
}

TYPED_TEST(SplineLevelsOf, PreconditionerIsSymmetricAndPositive) {
  constexpr int D = TypeParam::value;
  for (const Case& c : cases<D>()) {
    const Gradient<D> gradient = c.template gradient<D>();
    const FitResidual<D> K(c.cloud.X, c.graph, gradient);
    SplineLevels<D> B(K);
    const Field<D> x = rough<D>(K.particles(), 0.3), y = rough<D>(K.particles(), 1.1);
    const double x_By = x.cwiseProduct(times(B, y)).sum(), y_Bx = y.cwiseProduct(times(B, x)).sum();
    const double x_Bx = x.cwiseProduct(times(B, x)).sum();
    EXPECT_NEAR(x_By, y_Bx, 1e-13 * x_Bx);
    // Not less than one over the diagonal alone, of which everything else is added.
    const std::vector<double> diagonal = K.diagonal();
    double least = 0;
    for (std::int64_t a = 0; a < K.particles(); ++a)
      least += x.col(a).squaredNorm() / diagonal[a];
    EXPECT_GT(x_Bx, least);
  }
}

TYPED_TEST(SplineLevelsOf, PreconditionedOperatorDoesNotExceedAFew) {
  // Power iteration: were a spline's stiffness taken too small anywhere, this would show it.
  constexpr int D = TypeParam::value;
  for (const Case& c : cases<D>()) {
    const Gradient<D> gradient = c.template gradient<D>();
    FitResidual<D> K(c.cloud.X, c.graph, gradient);
    SplineLevels<D> B(K);
    Field<D> x = rough<D>(K.particles(), 0.7);
    double largest = 0;
    for (int i = 0; i < 60; ++i) {
      x = times(B, times(K, x));
      largest = x.norm();
      x /= largest;
    }
    EXPECT_GT(largest, 1);
    EXPECT_LT(largest, D == 3 ? 3.5 : 5.5);
  }
}

TEST(SplineLevels, IterationsHardlyGrowWithTheBody) {
  const auto of_lattice = [](int nx, int ny, int nz, double support) {
    const ParticleCloud cloud = test::box_lattice(nx, ny, nz, Vec3(nx - 1, ny - 1, nz - 1));
    return iterations(cloud, uniform_support(cloud.X, support * cloud.spacing));
  };
  EXPECT_LE(of_lattice(12, 12, 12, 1.6), 54);
  EXPECT_LE(of_lattice(25, 25, 25, 1.6), 62);
  EXPECT_LE(of_lattice(20, 20, 20, 2.2), 46);
  EXPECT_LE(of_lattice(6, 6, 31, 1.6), 73); // slender
}

TEST(SplineLevels, IterationsAreFewOnIrregularAndOnRefinedClouds) {
  const ParticleCloud irregular = test::jittered(test::box_lattice(25, 25, 25, Vec3(1, 1, 1)), 0.3, 1);
  EXPECT_LE(iterations(irregular, adaptive_support<3>(irregular.X, irregular.V, 30)), 48);
  // Five times as close at one end as at the other, and cells up to five times as long as they are wide.
  const ParticleCloud fine_corner = graded(16, 1.12);
  EXPECT_LE(iterations(fine_corner, adaptive_support<3>(fine_corner.X, fine_corner.V, 30)), 94);
}

TEST(SplineLevels, CorrectionHasTheSameBitsOnAnyThreads) {
  const ParticleCloud cloud = test::jittered(test::box_lattice(11, 11, 11, Vec3(1, 1, 1)), 0.3, 2);
  const Neighbours graph = adaptive_support<3>(cloud.X, cloud.V, 30);
  const Gradient<3> plain = build_gradient<3>(cloud.X, cloud.V, graph);
  const auto on = [&](int n) {
    set_threads(n);
    Gradient<3> gradient = plain;
    balance_constant_stress<3>(gradient, cloud.X, cloud.A, graph);
    set_threads(0);
    return gradient;
  };
  const Gradient<3> one = on(1), three = on(3);
  EXPECT_EQ(one.anchor, three.anchor);
  EXPECT_EQ(one.B, three.B);
}
