#include "solver/operators/consistent.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

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

/// lambda -> sum_a delta_ab - sum_c delta_bc: symmetric, positive semidefinite, zero on linear fields. The D
/// components of lambda lie together and do not see each other.
template <int D>
class FitResidual;

} // namespace
} // namespace tessera::solver

// Eigen's way of taking an operator that is no matrix.
template <int D>
struct Eigen::internal::traits<tessera::solver::FitResidual<D>>
    : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace tessera::solver {
namespace {

template <int D>
class FitResidual : public Eigen::EigenBase<FitResidual<D>> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  FitResidual(std::span<const Vec3> X, const Neighbours& neighbours, std::vector<double> omega)
      : X_(X), neighbours_(neighbours), omega_(std::move(omega)), inverse_moment_(X.size()), m_(X.size()) {
    for_each(neighbours.size(), [&](std::int64_t a) {
      Mat<D> moment = Mat<D>::Zero();
      over_edges(a, [&](std::int32_t, double w, const Vec<D>& R) { moment += w * R * R.transpose(); });
      inverse_moment_[a] = moment.inverse();
    });
  }

  Eigen::Index rows() const { return D * neighbours_.size(); }
  Eigen::Index cols() const { return rows(); }

  template <class Rhs>
  Eigen::Product<FitResidual, Rhs, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }

  /// Slopes m_a of the best linear fit to lambda around every particle.
  void fit(const double* lambda) const {
    const auto of = [&](std::int64_t a) { return Eigen::Map<const Vec<D>>(lambda + D * a); };
    for_each(neighbours_.size(), [&](std::int64_t a) {
      Mat<D> sum = Mat<D>::Zero();
      over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R) {
        sum += (w * (of(b) - of(a))) * R.transpose();
      });
      m_[a] = sum * inverse_moment_[a];
    });
  }

  /// result += scale * this * lambda.
  void add_to(double* result, const double* lambda, double scale) const {
    fit(lambda);
    const auto of = [&](std::int64_t a) { return Eigen::Map<const Vec<D>>(lambda + D * a); };
    for_each(neighbours_.size(), [&](std::int64_t a) {
      Vec<D> sum = Vec<D>::Zero();
      over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R) {
        sum += w * (2 * (of(a) - of(b)) + (m_[a] + m_[b]) * R);
      });
      Eigen::Map<Vec<D>>(result + D * a) += scale * sum;
    });
  }

  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd diagonal(rows());
    for_each(neighbours_.size(), [&](std::int64_t a) {
      double sum = 0;
      Vec<D> lean = Vec<D>::Zero();
      over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R) {
        sum += 2 * w - w * w * R.dot(inverse_moment_[b] * R);
        lean += w * R;
      });
      diagonal.segment<D>(D * a).setConstant(sum - lean.dot(inverse_moment_[a] * lean));
    });
    return diagonal;
  }

  /// Adds the change of lambda, whose slopes fit() has found, to the operators.
  void correct(Gradient<D>& gradient, std::span<const double> V, const double* lambda) const {
    const auto of = [&](std::int64_t a) { return Eigen::Map<const Vec<D>>(lambda + D * a); };
    for_each(neighbours_.size(), [&](std::int64_t a) {
      std::int64_t e = neighbours_.row[a];
      over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R) {
        const Vec<D> rise = of(b) - of(a);
        const Vec<D> delta_ab = w * (rise - m_[a] * R), delta_ba = w * (m_[b] * R - rise);
        gradient.w[e] += delta_ab / V[a];
        gradient.t[e] -= delta_ba / V[a];
        gradient.s[a] += delta_ab / V[a];
        ++e;
      });
    });
  }

 private:
  /// use(b, omega_ab, X_b - X_a) for all neighbours of a.
  template <class Use>
  void over_edges(std::int64_t a, Use&& use) const {
    for (std::int64_t e = neighbours_.row[a]; e < neighbours_.row[a + 1]; ++e) {
      const std::int32_t b = neighbours_.column[e];
      const Vec<D> R = (X_[b] - X_[a]).template head<D>();
      use(b, omega_[e], R);
    }
  }

  std::span<const Vec3> X_;
  const Neighbours& neighbours_;
  std::vector<double> omega_;
  std::vector<Mat<D>> inverse_moment_;
  mutable std::vector<Mat<D>> m_;
};

/// One over the diagonal, which is the operator's own to know.
class Jacobi {
 public:
  template <class Operator>
  Jacobi& compute(const Operator& K) {
    inverse_ = K.diagonal().cwiseInverse();
    return *this;
  }
  template <class Rhs>
  auto solve(const Rhs& r) const {
    return inverse_.cwiseProduct(r);
  }
  static Eigen::ComputationInfo info() { return Eigen::Success; }

 private:
  Eigen::VectorXd inverse_;
};

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
} // namespace tessera::solver

template <int D, class Rhs>
struct Eigen::internal::generic_product_impl<tessera::solver::FitResidual<D>, Rhs, Eigen::SparseShape,
                                             Eigen::DenseShape, Eigen::GemvProduct>
    : Eigen::internal::generic_product_impl_base<
          tessera::solver::FitResidual<D>, Rhs,
          Eigen::internal::generic_product_impl<tessera::solver::FitResidual<D>, Rhs>> {
  template <class Result>
  static void scaleAndAddTo(Result& result, const tessera::solver::FitResidual<D>& K, const Rhs& x,
                            double scale) {
    const Eigen::VectorXd lambda = x;
    K.add_to(result.data(), lambda.data(), scale);
  }
};

namespace tessera::solver {

template <int D>
std::int64_t balance_constant_stress(Gradient<D>& gradient, std::span<const Vec3> X,
                                     std::span<const double> V, std::span<const Vec3> A,
                                     const Neighbours& neighbours, const Kernel<D>& kernel) {
  require_balanced<D>(X, V, A);
  const FitResidual<D> K(X, neighbours, pair_weights<D>(X, V, neighbours, kernel));
  const Eigen::VectorXd lack = imbalance<D>(gradient, V, A, neighbours);
  Eigen::ConjugateGradient<FitResidual<D>, Eigen::Lower | Eigen::Upper, Jacobi> iteration;
  iteration.setTolerance(1e-14);
  iteration.setMaxIterations(20000);
  iteration.compute(K);
  const Eigen::VectorXd lambda = iteration.solve(lack);
  K.fit(lambda.data());
  K.correct(gradient, V, lambda.data());

  const double largest = max_of(neighbours.size(), 0.0, [&](std::int64_t a) { return A[a].norm(); });
  const double left = imbalance<D>(gradient, V, A, neighbours).cwiseAbs().maxCoeff() / largest;
  require(left < 1e-10,
          fmt::format("the operators of the scheme \"consistent\" did not converge: {:.2g} of the largest "
                      "surface area is left "
                      "after {} iterations",
                      left, iteration.iterations()),
          "solver.scheme", "raise solver.support or solver.neighbours, or choose the scheme \"thesis\"");
  return iteration.iterations();
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
