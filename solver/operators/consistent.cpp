#include "solver/operators/consistent.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solver/operators/fit_residual.hpp"
#include "solver/operators/spline_levels.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace tessera::solver {

namespace {

/// A_b - S_b: what the operators as they are lack.
template <int D>
Field<D> imbalance(const Gradient<D>& gradient, std::span<const Vec3> A, const Neighbours& neighbours) {
  Field<D> lack = Field<D>::Zero(Field<D>::RowsAtCompileTime, neighbours.size());
  for_each(neighbours.size(), [&](std::int64_t b) {
    Vec<D> force = Vec<D>::Zero(); // of the unit stress
    for (std::int64_t e = neighbours.row[b]; e < neighbours.row[b + 1]; ++e) {
      const std::int32_t c = neighbours.column[e];
      const auto d = gradient.reach(b, e, c);
      force +=
          (gradient.B[b] + gradient.B[c]) * d.col(0).template head<D>() + 2 * d.col(1).template head<D>();
    }
    lack.col(b).template head<D>() = A[b].head<D>() + force;
  });
  return lack;
}

/// The linear fields, which no residual of a fit has.
template <int D>
class LinearFields {
 public:
  explicit LinearFields(std::span<const Vec3> X)
      : X_(X), n_(static_cast<std::int64_t>(X.size())),
        centre_(sum(n_, Vec3(Vec3::Zero()), [&](std::int64_t a) -> Vec3 { return X[a]; }) / double(n_)),
        size_(max_of(n_, 0.0, [&](std::int64_t a) { return (X[a] - centre_).norm(); })) {
    inverse_gram_ = sum(n_, Gram(Gram::Zero()), [&](std::int64_t a) -> Gram {
                      return functions(a) * functions(a).transpose();
                    }).inverse();
  }

  /// Takes them out of a field: balanced areas leave rounding only, but that would grow.
  void remove_from(Field<D>& field) const {
    using Moments = Eigen::Matrix<double, Field<D>::RowsAtCompileTime, D + 1>;
    const Moments moments = sum(n_, Moments(Moments::Zero()), [&](std::int64_t a) -> Moments {
      return field.col(a) * functions(a).transpose();
    });
    const Moments share = moments * inverse_gram_;
    for_each(n_, [&](std::int64_t a) { field.col(a) -= share * functions(a); });
  }

 private:
  using Functions = Eigen::Matrix<double, D + 1, 1>;
  using Gram = Eigen::Matrix<double, D + 1, D + 1>;

  Functions functions(std::int64_t a) const {
    Functions f;
    f << 1, (X_[a] - centre_).template head<D>() / size_;
    return f;
  }

  std::span<const Vec3> X_;
  std::int64_t n_;
  Vec3 centre_;
  double size_;
  Gram inverse_gram_;
};

/// Preconditioned conjugate gradients for K lambda = r, with lambda from zero, until no component of what is
/// left in r is larger than `enough`. Returns the iterations.
template <int D>
std::int64_t solve(FitResidual<D>& K, SplineLevels<D>& preconditioner, const LinearFields<D>& linear,
                   double enough, Field<D>& r, Field<D>& lambda) {
  constexpr std::int64_t most = 1000;
  const Eigen::Index n = r.cols();
  const auto dot = [&](const Field<D>& a, const Field<D>& b) {
    return sum(n, 0.0, [&](std::int64_t i) { return a.col(i).dot(b.col(i)); });
  };
  const auto largest = [&] {
    return max_of(n, 0.0, [&](std::int64_t i) { return r.col(i).cwiseAbs().maxCoeff(); });
  };
  Field<D> z(r.rows(), n), p = Field<D>::Zero(r.rows(), n), Kp(r.rows(), n);
  lambda.setZero();
  double r_z = 1;
  std::int64_t iterations = 0;
  for (; iterations < most && largest() > enough; ++iterations) {
    linear.remove_from(r);
    preconditioner.apply(r, z);
    const double r_z_before = std::exchange(r_z, dot(r, z));
    const double beta = iterations == 0 ? 0 : r_z / r_z_before;
    for_each(n, [&](std::int64_t i) { p.col(i) = z.col(i) + beta * p.col(i); });
    K.multiply(p, Kp);
    const double p_Kp = dot(p, Kp);
    if (!(p_Kp > 0)) // nothing but rounding is left
      break;
    const double alpha = r_z / p_Kp;
    for_each(n, [&](std::int64_t i) {
      lambda.col(i) += alpha * p.col(i);
      r.col(i) -= alpha * Kp.col(i);
    });
  }
  return iterations;
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
std::int64_t balance_constant_stress(Gradient<D>& gradient, std::span<const Vec3> X, std::span<const Vec3> A,
                                     const Neighbours& neighbours) {
  require_balanced<D>(X, gradient.V, A);
  FitResidual<D> K(X, neighbours, gradient);
  SplineLevels<D> preconditioner(K);
  const LinearFields<D> linear(X);

  // Slender bodies have large lambda of which little is a residual: what rounding leaves is balanced again.
  const double surface = max_of(neighbours.size(), 0.0, [&](std::int64_t a) { return A[a].norm(); });
  constexpr double enough = 1e-13, good = 1e-10;
  constexpr int rounds = 6;
  std::int64_t iterations = 0;
  double left = 0;
  Field<D> lambda(Field<D>::RowsAtCompileTime, neighbours.size());
  for (int round = 0; round < rounds; ++round) {
    Field<D> lack = imbalance<D>(gradient, A, neighbours);
    left = lack.cwiseAbs().maxCoeff() / surface;
    if (left < enough)
      break;
    iterations += solve<D>(K, preconditioner, linear, enough / 3 * surface, lack, lambda);
    K.correct(gradient, lambda);
  }
  require(left < good,
          fmt::format("the operators of the scheme \"consistent\" did not converge: {:.2g} of the largest "
                      "surface area is left after {} iterations",
                      left, iterations),
          "solver.scheme", "raise solver.support or solver.neighbours, or choose the scheme \"thesis\"");
  return iterations;
}

template std::int64_t balance_constant_stress<2>(Gradient<2>&, std::span<const Vec3>, std::span<const Vec3>,
                                                 const Neighbours&);
template std::int64_t balance_constant_stress<3>(Gradient<3>&, std::span<const Vec3>, std::span<const Vec3>,
                                                 const Neighbours&);

} // namespace tessera::solver
