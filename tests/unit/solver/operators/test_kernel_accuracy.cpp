#include "solver/operators/gradient.hpp"
#include "solver/operators/laplacian.hpp"
#include "solver/operators/support.hpp"
#include "tests/support/clouds.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// A plane wave of that length, oblique to the lattice, and its derivatives. Inside a lattice the operators
/// turn it into one of the same shape: relative errors do not depend on where they are measured.
struct Wave {
  double length;
  Vec3 k = 2 * std::numbers::pi / length * Vec3(2, 2, 1) / 3;

  double operator()(const Vec3& x) const { return std::sin(k.dot(x)); }
  Vec3 gradient(const Vec3& x) const { return std::cos(k.dot(x)) * k; }
  double laplacian(const Vec3& x) const { return -k.squaredNorm() * std::sin(k.dot(x)); }
};

struct Operators {
  Neighbours graph;
  Gradient<3> gradient;
  Laplacian laplacian;

  Operators(const ParticleCloud& cloud, double support, const Kernel<3>& kernel)
      : graph(uniform_support(cloud.X, support * cloud.spacing)),
        gradient(build_gradient<3>(cloud.X, cloud.V, graph, kernel)),
        laplacian(build_laplacian<3>(cloud.X, cloud.V, graph, kernel)) {}
};

/// Relative L2 errors over the particles of a unit cube that are at least a support away from its surface.
struct Errors {
  double neighbours, gradient, laplacian;
};

Errors errors(const ParticleCloud& cloud, const Operators& of, const Wave& f) {
  const Neighbours& graph = of.graph;
  double inside = 0, neighbours = 0, g_error = 0, g_norm = 0, l_error = 0, l_norm = 0;
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    const Vec3& x = cloud.X[a];
    if (std::min(x.minCoeff(), 1 - x.maxCoeff()) < graph.support[a])
      continue;
    Vec3 g = Vec3::Zero();
    double l = -f(x) * of.laplacian.sum[a];
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      const std::int32_t b = graph.column[e];
      g += (f(cloud.X[b]) - f(x)) * of.gradient.w(a, e, b);
      l += f(cloud.X[b]) * of.laplacian.l[e];
    }
    inside += 1;
    neighbours += static_cast<double>(graph.count(a));
    g_error += (g - f.gradient(x)).squaredNorm();
    g_norm += f.gradient(x).squaredNorm();
    l_error += std::pow(l - f.laplacian(x), 2);
    l_norm += std::pow(f.laplacian(x), 2);
  }
  return {neighbours / inside, std::sqrt(g_error / g_norm), std::sqrt(l_error / l_norm)};
}

struct Choice {
  std::string kernel;
  double support; ///< over the spacing
};

/// All at the default support, then each at its own usual one: s = 2 h, of the Gaussian 3 h, with h = 1.2
/// spacings.
const std::vector<Choice> choices = {{"wendland", 2.2}, {"cubic", 2.2},    {"quartic", 2.2},
                                     {"quintic", 2.2},  {"gaussian", 2.2}, {"cubic", 2.4},
                                     {"quartic", 2.4},  {"quintic", 2.4},  {"gaussian", 3.6}};

} // namespace

/// Prints the table of docs/theory.md: 24 spacings a wave.
TEST(KernelAccuracy, SecondOrderInsideALatticeForEveryKernel) {
  const auto coarse = test::box_lattice(13, 13, 13, Vec3(1, 1, 1));
  const auto fine = test::box_lattice(25, 25, 25, Vec3(1, 1, 1));
  const auto irregular = test::jittered(fine, 0.2, 3);
  std::cout << "kernel    support  neighbours  gradient  Laplacian  moved by 0.2: gradient  Laplacian\n";
  const Wave wave{1};
  for (const auto& [name, support] : choices) {
    SCOPED_TRACE(fmt::format("{} {}", name, support));
    const Kernel<3> kernel{kernel_named(name)};
    const Errors before = errors(coarse, Operators(coarse, support, kernel), wave);
    const Errors after = errors(fine, Operators(fine, support, kernel), wave);
    const Errors moved = errors(irregular, Operators(irregular, support, kernel), wave);
    std::cout << fmt::format("{:9} {:7} {:11.0f} {:8.2f}% {:9.2f}% {:22.2f}% {:9.2f}%\n", name, support,
                             after.neighbours, 100 * after.gradient, 100 * after.laplacian,
                             100 * moved.gradient, 100 * moved.laplacian);
    EXPECT_NEAR(std::log2(before.gradient / after.gradient), 2, 0.1);
    EXPECT_NEAR(std::log2(before.laplacian / after.laplacian), 2, 0.1);
    EXPECT_LT(after.gradient, support < 3 ? 0.015 : 0.025);
    EXPECT_LT(after.laplacian, support < 3 ? 0.015 : 0.025);
    EXPECT_LT(moved.gradient, 0.026);
    EXPECT_LT(moved.laplacian, 0.09);
  }
}
