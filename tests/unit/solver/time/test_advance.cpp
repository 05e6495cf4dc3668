#include "solver/time/advance.hpp"

#include "solver/physics/formulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera::solver;

namespace {

/// Error at t = 1 of u' = u (u(0) = 1) in n steps of Heun's method.
double error(int n) {
  std::vector<double> u = {1.0};
  const double dt = 1.0 / n;
  for (int i = 0; i < n; ++i) {
    const auto u_n = u;
    advance(u, dt, std::vector<double>(u));
    average(u, u_n, dt, std::vector<double>(u));
  }
  return std::abs(u[0] - std::exp(1.0));
}

} // namespace

TEST(Advance, IsOfSecondOrder) {
  const double order = std::log2(error(100) / error(200));
  EXPECT_NEAR(order, 2, 0.02);
}

TEST(Advance, AmplifiesAsTheStabilityPolynomialSays) {
  // z = 1 + m + m^2 / 2 for u' = lambda u with m = lambda dt.
  std::vector<double> u = {1.0};
  const double m = -0.7;
  advance(u, m, std::vector<double>(u));
  average(u, std::vector<double>{1.0}, m, std::vector<double>(u));
  EXPECT_DOUBLE_EQ(u[0], 1 + m + m * m / 2);
}

TEST(Advance, AdvancesEveryFieldOfAFormulation) {
  PF<2> U(2), R(2);
  R.p[1] = {1, 2};
  R.F[0](0, 1) = 3;
  R.x[1] = {4, 5};
  advance(U, 0.5, R);
  EXPECT_EQ(U.p[1], (tessera::Vec<2>(0.5, 1)));
  EXPECT_EQ(U.F[0](0, 1), 1.5);
  EXPECT_EQ(U.x[1], (tessera::Vec<2>(2, 2.5)));
}
