// Isotropic functions in closed form against principal axes in long double, of the same argument to the bit.

#include "solver/physics/isotropic.hpp"

#include "solver/physics/strain.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

using Exact = Eigen::Matrix<long double, 3, 3>;
using ExactVec = Eigen::Matrix<long double, 3, 1>;

/// f of a symmetric tensor, of which f(principal values) gives its own.
template <class F>
Exact exactly(const Symmetric& A, const F& f) {
  const Eigen::SelfAdjointEigenSolver<Exact> eigen(A.matrix().cast<long double>());
  const ExactVec values = f(eigen.eigenvalues());
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

ExactVec without_mean(const ExactVec& values) {
  return values.array() - values.mean();
}
ExactVec log_deviators(const ExactVec& values) {
  return without_mean(values.array().log());
}

double error(const Symmetric& A, const Exact& exact) {
  return static_cast<double>((A.matrix().cast<long double>() - exact).norm() / exact.norm());
}

double log_error(const Symmetric& b) {
  return error(log_deviator(Deviation(b)), exactly(b, log_deviators));
}

Mat3 some_rotation(std::mt19937& random) {
  std::normal_distribution<double> number;
  return Eigen::Quaterniond(number(random), number(random), number(random), number(random))
      .normalized()
      .toRotationMatrix();
}

/// With these principal values on axes of every kind.
std::vector<Symmetric> turned(const Vec3& values) {
  std::mt19937 random(3);
  const Symmetric along{values[0], values[1], values[2], 0, 0, 0};
  std::vector<Symmetric> all = {along};
  for (int i = 0; i < 50; ++i)
    all.push_back(transform(some_rotation(random), along));
  return all;
}

/// Pairs of principal values from far apart to alike, and what the third is beside them.
std::vector<Vec3> meeting() {
  std::vector<Vec3> all;
  for (const double third : {0.6, 0.99, 1.01, 1.7})
    for (const double gap : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-13, 0.0})
      all.push_back({1, third, 1 + gap});
  return all;
}

double number_of(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Mat3 some_gradient(std::mt19937& random, double size) {
  Mat3 F = Mat3::Identity();
  for (int k = 0; k < 9; ++k)
    F.data()[k] += number_of(random, -size, size);
  return F;
}

} // namespace

TEST(LogDeviator, OfModerateStrains) {
  std::mt19937 random(1);
  for (const double size : {0.3, 0.1, 0.01})
    for (int i = 0; i < 500; ++i)
      EXPECT_LT(log_error(left_cauchy_green(some_gradient(random, size))), 5e-15 + 1e-17 / size) << size;
}

TEST(LogDeviator, OfTinyStrains) {
  // log(I + E) by its series: exact where principal values in long double are not, beside their ones.
  std::mt19937 random(6);
  for (const double size : {1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12})
    for (int i = 0; i < 200; ++i) {
      const Symmetric b = left_cauchy_green(some_gradient(random, size));
      const Exact E = b.matrix().cast<long double>() - Exact::Identity();
      Exact power = E, log_b = Exact::Zero();
      for (int k = 1; k < 12; ++k) {
        log_b += (k % 2 == 0 ? -1.0L : 1.0L) / k * power;
        power = power * E;
      }
      const Exact exact = log_b - log_b.trace() / 3 * Exact::Identity();
      EXPECT_LT(error(log_deviator(Deviation(b)), exact), 2e-15) << size;
    }
}

TEST(LogDeviator, WherePrincipalValuesMeet) {
  for (const Vec3& values : meeting())
    for (const Symmetric& b : turned(values))
      EXPECT_LT(log_error(b), 3e-15) << values.transpose();
}

TEST(LogDeviator, OfLargeStretches) {
  // 0.2 to 5: what rounding of b leaves of its smallest principal value.
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    Vec3 squared;
    for (double& value : squared)
      value = std::pow(25, number_of(random, -1, 1));
    if (i % 3 == 0)
      squared[1] = squared[0];
    const Symmetric b = transform(some_rotation(random), {squared[0], squared[1], squared[2], 0, 0, 0});
    EXPECT_LT(log_error(b), 4e-16 * squared.maxCoeff() / squared.minCoeff() + 4e-15) << squared.transpose();
  }
}

TEST(LogDeviator, VanishesWithoutADeviator) {
  EXPECT_EQ(log_deviator(Deviation(Symmetric::identity())).matrix(), Mat3::Zero());
  EXPECT_EQ(log_deviator(Deviation(Symmetric{7, 7, 7, 0, 0, 0})).matrix(), Mat3::Zero());
}

TEST(Exponential, OfSmallAndLargeDeviators) {
  std::mt19937 random(4);
  for (const double size : {1e-10, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0})
    for (int i = 0; i < 100; ++i) {
      const Vec3 values = size * Vec3(number_of(random, -1, 1), number_of(random, -1, 1), 0);
      const Symmetric A = deviator(
          transform(some_rotation(random), {values[0], values[1], i % 3 == 0 ? values[0] : 0, 0, 0, 0}));
      EXPECT_LT(error(exponential(Deviator(A)),
                      exactly(A, [](const ExactVec& v) -> ExactVec { return v.array().exp(); })),
                3e-15)
          << values.transpose();
    }
}

TEST(PrincipalValues, OfEveryArrangement) {
  for (const Vec3& values : meeting())
    for (const Symmetric& A : turned(values)) {
      const Symmetric X = deviator(A);
      const Vec3 found = PrincipalValues(Deviator(X)).values();
      const Vec3 sorted(std::min(found[0], found[2]), found[1], std::max(found[0], found[2]));
      const Eigen::SelfAdjointEigenSolver<Exact> eigen(X.matrix().cast<long double>());
      EXPECT_LT((sorted - without_mean(eigen.eigenvalues()).cast<double>()).norm() / sorted.norm(), 2e-15)
          << values.transpose();
    }
  EXPECT_EQ(PrincipalValues(Deviator(Symmetric{})).values(), Vec3::Zero());
}

TEST(PrincipalValues, FunctionsOfThemHaveTheSameAxes) {
  // Powers, as Ogden's law needs them.
  for (const double power : {-1.5, 0.65, 3.0})
    for (const Vec3& values : meeting())
      for (const Symmetric& b : turned(values)) {
        const Deviation deviation(b);
        const PrincipalValues principal(deviation);
        const Vec3 powers = (deviation.mean * (1 + principal.values().array())).pow(power);
        EXPECT_LT(error(principal.function(powers),
                        exactly(b, [&](const ExactVec& v) -> ExactVec { return v.array().pow(power); })),
                  5e-15)
            << values.transpose();
      }
}

TEST(SquaredStretches, SmallestFirst) {
  std::mt19937 random(5);
  for (const Vec3& squared : {Vec3(0.2, 0.7, 3), Vec3(0.5, 0.5, 2), Vec3(0.5, 2, 2), Vec3(1, 1, 1)})
    for (int i = 0; i < 20; ++i) {
      const Mat3 F = some_rotation(random) * squared.cwiseSqrt().asDiagonal() * some_rotation(random);
      EXPECT_LT((squared_stretches(F) - squared).norm(), 1e-14);
    }
}
