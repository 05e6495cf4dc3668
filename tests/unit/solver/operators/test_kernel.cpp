#include "solver/operators/kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace tessera::solver;

namespace {

/// Gauss-Legendre on [0, s] in 40 pieces of 5 points.
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

} // namespace

TEST(Wendland, IntegratesToOneInEveryDimension) {
  const double s = 0.37, pi = std::numbers::pi;
  EXPECT_NEAR(integrate(s, [&](double r) { return 2 * Wendland<1>::value(r, s); }), 1, 1e-12);
  EXPECT_NEAR(integrate(s, [&](double r) { return 2 * pi * r * Wendland<2>::value(r, s); }), 1, 1e-12);
  EXPECT_NEAR(integrate(s, [&](double r) { return 4 * pi * r * r * Wendland<3>::value(r, s); }), 1, 1e-12);
}

template <int D>
void derivatives() {
  const double s = 1.7, h = 1e-5;
  for (const double r : {0.2, 0.7, 1.3, 1.65}) {
    using W = Wendland<D>;
    const double slope = (W::value(r + h, s) - W::value(r - h, s)) / (2 * h);
    const double curvature = (W::value(r + h, s) - 2 * W::value(r, s) + W::value(r - h, s)) / (h * h);
    EXPECT_NEAR(W::slope_over_r(r, s), slope / r, 1e-8) << r;
    EXPECT_NEAR(W::laplacian(r, s), curvature + (D - 1) * slope / r, 2e-5) << r;
  }
}

TEST(Wendland, DerivativesMatchDifferences) {
  derivatives<1>();
  derivatives<2>();
  derivatives<3>();
}

TEST(Wendland, VanishesAtAndBeyondItsRadius) {
  for (const double r : {1.0, 1.5}) {
    EXPECT_EQ(Wendland<3>::value(r, 1), 0);
    EXPECT_EQ(Wendland<3>::slope_over_r(r, 1), 0);
    EXPECT_EQ(Wendland<3>::laplacian(r, 1), 0);
  }
}
