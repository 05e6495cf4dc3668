#include "solver/physics/plasticity/hardening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace tessera::solver;

namespace {

/// Aluminium of the extrusion, (5.7), and its elasticity.
const PowerHardening aluminium{159e6, 0.02, 0.27};
constexpr double mu = 26e9;

/// Simpson's rule on the yield stress.
template <class Hardening>
double integral(const Hardening& hardening, double eps) {
  constexpr int pieces = 20000;
  const double h = eps / pieces;
  double sum = 0;
  for (int i = 0; i < pieces; ++i)
    sum += hardening.yield_stress(i * h) + 4 * hardening.yield_stress((i + 0.5) * h) +
           hardening.yield_stress((i + 1) * h);
  return sum * h / 6;
}

} // namespace

TEST(Hardening, PlasticWorkIsTheIntegralOfTheYieldStress) {
  for (const double eps : {1e-3, 0.3, 4.0}) {
    EXPECT_NEAR(LinearHardening({0.4e9, 0.1e9}).work(eps) / integral(LinearHardening{0.4e9, 0.1e9}, eps), 1,
                1e-12);
    EXPECT_NEAR(aluminium.work(eps) / integral(aluminium, eps), 1, 1e-10);
  }
  EXPECT_EQ(aluminium.work(0), 0);
}

TEST(Hardening, PowerIsLinearAndPerfectAtItsEnds) {
  const PowerHardening straight{2e8, 0.5, 1}, flat{2e8, 0.5, 0};
  const LinearHardening line{1e8, 2e8}, level{2e8, 0};
  for (const double eps : {0.0, 0.1, 3.0}) {
    EXPECT_DOUBLE_EQ(straight.yield_stress(eps), line.yield_stress(eps));
    EXPECT_NEAR(straight.work(eps), line.work(eps), 1e-14 * line.work(3));
    EXPECT_NEAR(straight.return_to_yield(2e9, eps, mu) / line.return_to_yield(2e9, eps, mu), 1, 1e-13);
    EXPECT_EQ(flat.yield_stress(eps), 2e8);
    EXPECT_NEAR(flat.return_to_yield(2e9, eps, mu) / level.return_to_yield(2e9, eps, mu), 1, 1e-14);
  }
}

TEST(Hardening, ReturnsToTheYieldSurface) {
  for (const double exponent : {0.0, 0.05, 0.27, 0.9, 1.0})
    for (const double offset : {1e-9, 0.02, 3.0})
      for (const double eps : {0.0, 1e-4, 2.0})
        for (const double beyond : {1e-9, 1e-3, 0.5, 40.0})
          for (const double shear : {1e4, 1e8, 26e9}) {
            const PowerHardening hardening{159e6, offset, exponent};
            const double trial = (1 + beyond) * hardening.yield_stress(eps);
            const double multiplier = hardening.return_to_yield(trial, eps, shear);
            EXPECT_GE(multiplier, 0);
            EXPECT_NEAR((trial - 3 * shear * multiplier) / hardening.yield_stress(eps + multiplier), 1, 1e-12)
                << exponent << " " << offset << " " << eps << " " << beyond << " " << shear;
          }
}

TEST(Hardening, ReturnOfSomethingThatIsNoNumberEnds) {
  EXPECT_FALSE(std::isnan(aluminium.return_to_yield(std::nan(""), 0.1, mu)));
  EXPECT_FALSE(std::isnan(aluminium.return_to_yield(1e9, std::nan(""), mu)));
}

TEST(DecreasingRoot, ConvergesQuadratically) {
  // The residual of a return to the yield surface, with its root known: errors square from step to step.
  const double root = 0.37;
  std::vector<double> errors;
  const double found = decreasing_root(
      [&](double d) -> Tangent {
        errors.push_back(std::abs(d - root));
        return {root - d + 2 * (std::sqrt(0.01 + root) - std::sqrt(0.01 + d)), -1 - 1 / std::sqrt(0.01 + d)};
      },
      0, 5, 1e-15);
  EXPECT_NEAR(found, root, 1e-15);
  EXPECT_LE(errors.size(), 7U);
  // e' = f''/(2 f') e^2 with f'' = 1/2 (0.38)^(-3/2) and f' = -(1 + 0.38^(-1/2)): 0.41.
  for (std::size_t i = 2; i + 1 < errors.size() && errors[i + 1] > 1e-13; ++i)
    EXPECT_LT(errors[i + 1], 0.5 * errors[i] * errors[i]);
}

TEST(DecreasingRoot, EndsWhereNewtonWouldNot) {
  // Newton's steps on -cbrt(d - root) double the distance for ever.
  int calls = 0;
  const double root = 0.3;
  const double found = decreasing_root(
      [&](double d) -> Tangent {
        ++calls;
        return {-std::cbrt(d - root), -1 / (3 * std::cbrt((d - root) * (d - root)))};
      },
      0, 1, 0);
  EXPECT_NEAR(found, root, 1e-15);
  EXPECT_LT(calls, 100);
  // And where there is nothing to find.
  calls = 0;
  EXPECT_NEAR(decreasing_root(
                  [&](double) -> Tangent {
                    return {double(++calls), -1e-3};
                  },
                  0, 1, 0),
              1, 1e-15);
  EXPECT_LT(calls, 100);
}
