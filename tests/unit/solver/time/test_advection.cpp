#include "solver/time/advection.hpp"

#include "core/tensor.hpp"
#include "solver/operators/kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double pi = std::numbers::pi;

/// Weights at a - 4 ... a + 4 of what the schemes do: gradient, and the central second difference of the
/// kernel's Laplacian.
struct Weights {
  std::array<double, 9> gradient{}, fourth{};
};

/// From the program's own one-dimensional kernel, corrected here as (4.8) and (4.12) say.
Weights weights_of_kernel(int per_side) {
  const Kernel<1> W{KernelShape::quintic};
  double slopes = 0, squares = 0, rough = 0;
  for (int j = 1; j < per_side; ++j) {
    slopes += -2 * j * j * W.slope_over_r(j, per_side);
    squares += j * j * W.laplacian(j, per_side);
    rough += 2 * W.laplacian(j, per_side);
  }
  Weights weights;
  for (int j = -per_side + 1; j < per_side; ++j) {
    weights.gradient[static_cast<std::size_t>(4 + j)] = -j * W.slope_over_r(std::abs(j), per_side) / slopes;
    const double l = (j == 0 ? -rough : W.laplacian(std::abs(j), per_side)) / squares;
    for (const int k : {-1, 0, 1})
      weights.fourth[static_cast<std::size_t>(4 + j + k)] += (k == 0 ? -2 : 1) * l;
  }
  return weights;
}

/// lambda dx/c of a wave by summing the weights.
Complex summed(const Weights& weights, double kappa4, double Phi) {
  Complex sum = 0;
  for (int j = -4; j <= 4; ++j)
    sum -= (weights.gradient[static_cast<std::size_t>(4 + j)] +
            kappa4 * weights.fourth[static_cast<std::size_t>(4 + j)]) *
           std::polar(1.0, j * Phi);
  return sum;
}

} // namespace

TEST(Advection, ClosedFormsAreThoseOfTheKernelsStencils) {
  for (const int per_side : {2, 3}) {
    const Weights weights = weights_of_kernel(per_side);
    for (const double kappa4 : {0.0, 1.0 / 16, 1.0 / 8})
      for (const double courant : {0.3, 0.5, 1.0})
        for (int i = -64; i <= 64; ++i) {
          const double Phi = pi * i / 64;
          const AdvectionScheme scheme{per_side, kappa4};
          const Complex lambda = summed(weights, kappa4, Phi);
          EXPECT_LT(std::abs(advection_eigenvalue(scheme, Phi) - lambda), 1e-12);
          EXPECT_LT(std::abs(advection_amplification(scheme, courant, Phi) - 1.0 - courant * lambda -
                             0.5 * courant * courant * lambda * lambda),
                    1e-12);
        }
  }
}

TEST(Advection, SpectrumOfAPeriodicLatticeIsTheClosedForm) {
  constexpr int n = 60;
  for (const int per_side : {2, 3}) {
    const Weights weights = weights_of_kernel(per_side);
    for (const double kappa4 : {0.0, 1.0 / 16}) {
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
      for (int a = 0; a < n; ++a)
        for (int j = -4; j <= 4; ++j)
          A(a, (a + j + n) % n) -= weights.gradient[static_cast<std::size_t>(4 + j)] +
                                   kappa4 * weights.fourth[static_cast<std::size_t>(4 + j)];
      const Eigen::VectorXcd found = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
      std::vector<Complex> expected;
      for (int k = 0; k < n; ++k)
        expected.push_back(advection_eigenvalue({per_side, kappa4}, 2 * pi * k / n));
      for (const Complex lambda : found) { // each takes its own
        const auto nearest = std::min_element(expected.begin(), expected.end(), [&](Complex p, Complex q) {
          return std::abs(p - lambda) < std::abs(q - lambda);
        });
        EXPECT_LT(std::abs(*nearest - lambda), 1e-10);
        expected.erase(nearest);
      }
    }
  }
}

TEST(Advection, TablesAreThoseOfChapterFour) {
  const auto two = kernel_table(2), three = kernel_table(3);
  const auto expect_row = [](const KernelRow& row, std::array<double, 5> plain,
                             std::array<double, 3> corrected) {
    for (std::size_t m = 0; m < 5; ++m)
      EXPECT_NEAR(row.derivative[m], plain[m], 1e-12) << row.offset << " " << m;
    for (std::size_t m = 0; m < 3; ++m)
      EXPECT_NEAR(row.corrected[m], corrected[m], 1e-14) << row.offset << " " << m;
  };
  ASSERT_EQ(two.size(), 5U);
  expect_row(two[0], {0, 0, 0, 0, 0}, {0, 0, 0});
  expect_row(two[2], {2, 0, -20, 90, -210}, {8.0 / 9, 0, -2});
  expect_row(two[3], {1.0 / 8, 5.0 / 8, 5.0 / 2, 15.0 / 2, 15}, {1.0 / 18, 1.0 / 2, 1});
  ASSERT_EQ(three.size(), 7U);
  expect_row(three[3], {4.0 / 3, 0, -160.0 / 27, 160.0 / 9, -2240.0 / 81}, {243.0 / 373, 0, -7.0 / 5});
  expect_row(three[4], {28.0 / 81, 200.0 / 243, 320.0 / 243, 0, -640.0 / 81},
             {63.0 / 373, 15.0 / 34, 3.0 / 5});
  expect_row(three[5], {8.0 / 729, 40.0 / 729, 160.0 / 729, 160.0 / 243, 320.0 / 243},
             {2.0 / 373, 1.0 / 34, 1.0 / 10});
}

TEST(Advection, LimitsAreWhereWavesBeginToGrow) {
  EXPECT_EQ(largest_courant({2, 0}), 0);
  EXPECT_EQ(largest_courant({3, 0}), 0);
  for (const int per_side : {2, 3})
    for (const double kappa4 : {1.0 / 64, 1.0 / 16, 0.2, 0.5}) {
      const AdvectionScheme scheme{per_side, kappa4};
      const double limit = largest_courant(scheme);
      const auto largest = [&](double courant) {
        double most = 0;
        for (int i = 1; i <= 1000; ++i)
          most = std::max(most, std::abs(advection_amplification(scheme, courant, pi * i / 1000)));
        return most;
      };
      EXPECT_LE(largest(0.999 * limit), 1);
      EXPECT_GT(largest(1.001 * limit), 1 + 1e-15);
    }
  // Rough waves rule where the dissipation is strong: 16 kappa4 courant = 2 of two particles per side.
  EXPECT_NEAR(largest_courant({2, 0.5}), 0.25, 1e-6);
  EXPECT_NEAR(first_to_grow({2, 0.5}), pi, 1e-3);
  EXPECT_DOUBLE_EQ(largest_courant({3, 1.0 / 16}), 2 * std::cbrt(1.0 / 16));
}

TEST(Advection, BothSchemesAreOfSecondOrderWithTheThesisLeadingTerm) {
  // 1/6 and 23/102 of Phi^2: the wider stencil lags more.
  for (const double Phi : {0.02, 0.04}) {
    const auto lag = [&](int per_side) {
      return (1 + advection_eigenvalue({per_side, 0}, Phi).imag() / Phi) / (Phi * Phi);
    };
    EXPECT_NEAR(lag(2), 1.0 / 6, 1e-3);
    EXPECT_NEAR(lag(3), 23.0 / 102, 1e-3);
    EXPECT_LT(dispersion_error({3, 0}, 0.1, Phi), dispersion_error({2, 0}, 0.1, Phi));
  }
  EXPECT_EQ(dispersion_error({2, 0}, 0.5, 0), 1);
}

TEST(StabilityRegion, EdgesAreWhereAStepNeitherGrowsNorFalls) {
  for (const Complex z : heun_region(101)) {
    EXPECT_NEAR(std::abs(heun_amplification(z)), 1, 1e-14);
    EXPECT_GE(z.imag(), 0);
    EXPECT_NEAR(heun_growth(z), 0, 1e-13);
  }
  EXPECT_NEAR(heun_growth({-0.3, 0.7}), std::norm(heun_amplification({-0.3, 0.7})) - 1, 1e-15);
  EXPECT_NEAR(heun_growth({0, 1e-3}), 0.25e-12, 1e-26);
  // A mode on Verlet's edge: a root of its step is -1.
  for (const Complex z : verlet_region(11)) {
    const double a = std::norm(z), b = -2 * z.real();
    EXPECT_NEAR(a + 2 * b, 4, 1e-13);
    EXPECT_GE(z.imag(), -1e-15);
    EXPECT_LE(z.real(), 1e-15);
  }
}
