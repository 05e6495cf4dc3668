#include "solver/operators/consistent.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solver/operators/fit_residual.hpp"
#include "solver/operators/two_level.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tessera::solver {

template <int D>
std::vector<double> pair_weights(std::span<const Vec3> X, std::span<const double> V,
                                 const Neighbours& neighbours, const Kernel<D>& kernel) {
  std::vector<double> omega(static_cast<std::size_t>(neighbours.edges()));
  for_each(neighbours.size(), [&](std::int64_t a) {
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
      const std::int32_t b = neighbours.column[e];
      omega[e] = -V[a] * V[b] * kernel.slope_over_r((X[a] - X[b]).norm(), neighbours.pair_support(a, b));
    }
  });
  return omega;
}

namespace {

/// A_b - S_b: what the operators as they are lack, component by component.
template <int D>
Eigen::VectorXd imbalance(const Gradient<D>& gradient, std::span<const double> V, std::span<const Vec3> A,
                          const Neighbours& neighbours) {
  Eigen::VectorXd lack(D * neighbours.size());
  for_each(neighbours.size(), [&](std::int64_t b) {
    Vec<D> force = gradient.s[b]; // of the unit stress, over V_b
    for (std::int64_t e = neighbours.row[b]; e < neighbours.row[b + 1]; ++e)
      force += gradient.t[e];
    lack.segment<D>(D * b) = A[b].head<D>() + V[b] * force;
  });
  return lack;
}

/// Takes the linear fields out of a field's components, which no residual of a fit has: balanced areas leave
/// rounding only.
template <int D>
void without_linear_fields(std::span<const Vec3> X, Eigen::VectorXd& field) {
  using Functions = Eigen::Matrix<double, D + 1, 1>;
  using Moments = Eigen::Matrix<double, D + 1, 2 * D + 1>; // of the functions | of the field with them
  const auto n = static_cast<std::int64_t>(X.size());
  const Vec3 centre = sum(n, Vec3(Vec3::Zero()), [&](std::int64_t a) -> Vec3 { return X[a]; }) / double(n);
  const double size = max_of(n, 0.0, [&](std::int64_t a) { return (X[a] - centre).norm(); });
  const auto functions = [&](std::int64_t a) {
    Functions f;
    f << 1, (X[a] - centre).template head<D>() / size;
    return f;
  };
  const Moments moments = sum(n, Moments(Moments::Zero()), [&](std::int64_t a) -> Moments {
    const Functions f = functions(a);
    Moments m;
    m << f * f.transpose(), f * field.segment<D>(D * a).transpose();
    return m;
  });
  const Eigen::Matrix<double, D + 1, D> share =
      moments.template leftCols<D + 1>().ldlt().solve(moments.template rightCols<D>());
  for_each(n, [&](std::int64_t a) { field.segment<D>(D * a) -= share.transpose() * functions(a); });
}

template <int D>
void require_balanced(std::span<const Vec3> X, std::span<const double> V, std::span<const Vec3> A) {
  const auto n = static_cast<std::int64_t>(X.size());
  const double volume = sum(n, 0.0, [&](std::int64_t a) { return V[a]; });
  const double area = sum(n, 0.0, [&](std::int64_t a) { return A[a].norm(); });
  const Vec3 total = sum(n, Vec3(Vec3::Zero()), [&](std::int64_t a) -> Vec3 { return A[a]; });
  const Mat3 moment =
      sum(n, Mat3(Mat3::Zero()), [&](std::int64_t a) -> Mat3 { return (X[a] - X[0]) * A[a].transpose(); });
  const Mat<D> lack = moment.topLeftCorner<D, D>() / volume - Mat<D>::Identity();
  constexpr double tolerance = 1e-9;
  require(total.norm() <= tolerance * area && lack.norm() <= tolerance,
          fmt::format(
              "the cloud's surface areas do not balance a constant stress (sum A is {:.2g} of the surface, "
              "sum X A misses the volume by {:.2g}), which the scheme \"consistent\" needs",
              area > 0 ? total.norm() / area : 0, lack.norm()),
          "cloud", "prepare the cloud again, or choose solver.scheme = \"thesis\"");
}

} // namespace

template <int D>
std::int64_t balance_constant_stress(Gradient<D>& gradient, std::span<const Vec3> X,
                                     std::span<const double> V, std::span<const Vec3> A,
                                     const Neighbours& neighbours, const Kernel<D>& kernel) {
  require_balanced<D>(X, V, A);
  const FitResidual<D> K(X, neighbours, pair_weights<D>(X, V, neighbours, kernel));
  Eigen::ConjugateGradient<FitResidual<D>, Eigen::Lower | Eigen::Upper, TwoLevel<D>> iteration;
  iteration.setTolerance(1e-9);
  iteration.setMaxIterations(5000);
  iteration.compute(K);

  // Slender bodies have large lambda of which little is a residual: what rounding leaves is balanced again.
  const double surface = max_of(neighbours.size(), 0.0, [&](std::int64_t a) { return A[a].norm(); });
  constexpr double enough = 1e-13, good = 1e-10;
  constexpr int rounds = 6;
  std::int64_t iterations = 0;
  double left = 0;
  for (int round = 0; round < rounds; ++round) {
    Eigen::VectorXd lack = imbalance<D>(gradient, V, A, neighbours);
    left = lack.cwiseAbs().maxCoeff() / surface;
    if (left < enough)
      break;
    without_linear_fields<D>(X, lack);
    const Eigen::VectorXd lambda = iteration.solve(lack);
    iterations += iteration.iterations();
    K.fit(lambda.data());
    K.correct(gradient, V, lambda.data());
  }
  require(left < good,
          fmt::format("the operators of the scheme \"consistent\" did not converge: {:.2g} of the largest "
                      "surface area is left after {} iterations",
                      left, iterations),
          "solver.scheme", "raise solver.support or solver.neighbours, or choose the scheme \"thesis\"");
  return iterations;
}

template std::vector<double> pair_weights<2>(std::span<const Vec3>, std::span<const double>,
                                             const Neighbours&, const Kernel<2>&);
template std::vector<double> pair_weights<3>(std::span<const Vec3>, std::span<const double>,
                                             const Neighbours&, const Kernel<3>&);
template std::int64_t balance_constant_stress<2>(Gradient<2>&, std::span<const Vec3>, std::span<const double>,
                                                 std::span<const Vec3>, const Neighbours&, const Kernel<2>&);
template std::int64_t balance_constant_stress<3>(Gradient<3>&, std::span<const Vec3>, std::span<const double>,
                                                 std::span<const Vec3>, const Neighbours&, const Kernel<3>&);

} // namespace tessera::solver
