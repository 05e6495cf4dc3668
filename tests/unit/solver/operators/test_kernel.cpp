#include "solver/operators/kernel.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double pi = std::numbers::pi;

/// Gauss-Legendre on [0, s] in 40 pieces of 5 points: the knots of all splines end a piece.
template <class F>
double integrate(double s, F&& f) {
  constexpr std::array<double, 5> x = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                       0.9061798459386640};
  constexpr std::array<double, 5> w = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                       0.4786286704993665, 0.2369268850561891};
  double total = 0;
  const double half = s / 80;
  for (int piece = 0; piece < 40; ++piece)
    for (int i = 0; i < 5; ++i)
      total += w[i] * half * f((2 * piece + 1) * half + half * x[i]);
  return total;
}

class EveryKernel : public ::testing::TestWithParam<std::string> {
 protected:
  /// Calls use(kernel) in one, two and three dimensions.
  template <class Use>
  void in_each_dimension(Use&& use) {
    const KernelShape shape = kernel_named(GetParam());
    use.template operator()<1>(Kernel<1>{shape});
    use.template operator()<2>(Kernel<2>{shape});
    use.template operator()<3>(Kernel<3>{shape});
  }
};

} // namespace

TEST_P(EveryKernel, IntegratesToOne) {
  in_each_dimension([]<int D>(const Kernel<D>& W) {
    const double s = 0.37;
    const auto sphere = [](double r) { return D == 1 ? 2 : D == 2 ? 2 * pi * r : 4 * pi * r * r; };
    EXPECT_NEAR(integrate(s, [&](double r) { return sphere(r) * W.value(r, s); }), 1, 1e-12) << D;
  });
}

TEST_P(EveryKernel, DerivativesMatchDifferences) {
  in_each_dimension([]<int D>(const Kernel<D>& W) {
    const double s = 1.7, h = 1e-5;
    for (const double r : {0.2, 0.7, 1.3, 1.65}) {
      const double slope = (W.value(r + h, s) - W.value(r - h, s)) / (2 * h);
      const double curvature = (W.value(r + h, s) - 2 * W.value(r, s) + W.value(r - h, s)) / (h * h);
      EXPECT_NEAR(W.slope_over_r(r, s), slope / r, 1e-8) << D << " " << r;
      EXPECT_NEAR(W.laplacian(r, s), curvature + (D - 1) * slope / r, 2e-5) << D << " " << r;
    }
  });
}

TEST_P(EveryKernel, IsSmoothAtItsCentre) {
  in_each_dimension([]<int D>(const Kernel<D>& W) {
    const double s = 0.8, curvature = W.slope_over_r(0, s);
    EXPECT_NEAR(W.laplacian(0, s) / (D * curvature), 1, 1e-14) << D;
    for (const double r : {1e-14, 1e-11, 1e-8}) // no cancellation in W' / r
      EXPECT_NEAR(W.slope_over_r(r, s) / curvature, 1, 1e-7) << D << " " << r;
  });
}

TEST_P(EveryKernel, FallsFromItsCentreToNothingAtItsRadius) {
  in_each_dimension([]<int D>(const Kernel<D>& W) {
    for (double r = 0; r < 1; r += 1.0 / 1024) {
      EXPECT_GT(W.value(r, 1), 0) << D << " " << r;
      EXPECT_LT(W.slope_over_r(r, 1), 0) << D << " " << r;
    }
    for (const double r : {1.0, 1.5}) {
      EXPECT_EQ(W.value(r, 1), 0);
      EXPECT_EQ(W.slope_over_r(r, 1), 0);
      EXPECT_EQ(W.laplacian(r, 1), 0);
    }
    EXPECT_LT(W.value(0.9999999, 1) / W.value(0, 1), 1.3e-4); // where the Gaussian is cut
  });
}

INSTANTIATE_TEST_SUITE_P(Named, EveryKernel, ::testing::ValuesIn(kernel_names()),
                         [](const auto& named) { return named.param; });

TEST(Kernel, PeaksAreThoseOfTheLiterature) {
  const auto peak = []<int D>(const Kernel<D>& W, double s) { return W.value(0, s); };
  EXPECT_NEAR(peak(Kernel<2>{}, 1), 7 / pi, 1e-14);
  EXPECT_NEAR(peak(Kernel<3>{}, 1), 21 / (2 * pi), 1e-14);
  // s = 2 h with h = 1.
  EXPECT_NEAR(peak(Kernel<1>{KernelShape::cubic}, 2), 2.0 / 3, 1e-15);
  EXPECT_NEAR(peak(Kernel<2>{KernelShape::cubic}, 2), 10 / (7 * pi), 1e-15);
  EXPECT_NEAR(peak(Kernel<3>{KernelShape::cubic}, 2), 1 / pi, 1e-15);
  EXPECT_NEAR(peak(Kernel<1>{KernelShape::quintic}, 2), 1, 1e-15);
  EXPECT_NEAR(peak(Kernel<2>{KernelShape::quintic}, 2), 3 / pi, 1e-15);
  EXPECT_NEAR(peak(Kernel<3>{KernelShape::quintic}, 2), 14 / (5 * pi), 1e-15);
  // s = 5/2 h: 230/16 of 1/24, 96/(1199 pi) and 1/(20 pi).
  EXPECT_NEAR(peak(Kernel<1>{KernelShape::quartic}, 2.5), 14.375 / 24, 1e-15);
  EXPECT_NEAR(peak(Kernel<2>{KernelShape::quartic}, 2.5), 14.375 * 96 / (1199 * pi), 1e-15);
  EXPECT_NEAR(peak(Kernel<3>{KernelShape::quartic}, 2.5), 14.375 / (20 * pi), 1e-15);
  // s = 3 h: cut off are the tails beyond 18 of chi-squared distributions with D degrees of freedom.
  EXPECT_NEAR(peak(Kernel<1>{KernelShape::gaussian}, 3) * std::sqrt(pi), 1 / std::erf(3.0), 1e-14);
  EXPECT_NEAR(peak(Kernel<2>{KernelShape::gaussian}, 3) * pi, 1 / (1 - std::exp(-9.0)), 1e-14);
  EXPECT_NEAR(peak(Kernel<3>{KernelShape::gaussian}, 3) * std::pow(pi, 1.5), 1 / (1 - 4.39849653e-4), 1e-11);
}

TEST(Kernel, TheQuinticSplineGivesTheStencilsOfTheStabilityAnalysis) {
  // Three particles a support length, s = 3: (u2 + 15 u1 - ...) / 34 and (1/10, 3/5, ...) of chapter 4.
  const Kernel<1> W{KernelShape::quintic};
  EXPECT_NEAR(W.slope_over_r(1, 3) / (2 * W.slope_over_r(2, 3)), 15, 1e-12);
  EXPECT_NEAR(W.laplacian(1, 3) / W.laplacian(2, 3), 6, 1e-12);
}

TEST(Kernel, DefaultIsWendland) {
  EXPECT_EQ(kernel_names().front(), "wendland");
  EXPECT_EQ(Kernel<3>{}.shape, kernel_named("wendland"));
  EXPECT_EQ(Kernel<3>{}.value(0.3, 1), Wendland<3>::value(0.3, 1));
}

TEST(Kernel, UnknownNameIsAnErrorThatNamesTheChoices) {
  try {
    kernel_named("qubic");
    FAIL() << "found";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "there is no kernel \"qubic\", solver.kernel, use one of wendland, cubic, "
                               "quartic, quintic, gaussian");
  }
}
