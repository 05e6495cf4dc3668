/// What the best linear fits around all particles leave of a field, as a linear operator.
#pragma once

#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/operators/gradient.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tessera::solver {
template <int D>
class FitResidual;
}

// Eigen's way of taking an operator that is no matrix.
template <int D>
struct Eigen::internal::traits<tessera::solver::FitResidual<D>>
    : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace tessera::solver {

/// lambda -> sum_a delta_ab - sum_c delta_bc with delta_ab = omega_ab (lambda_b - lambda_a - m_a . (X_b -
/// X_a)) and m_a the slope of the best fit: symmetric, positive semidefinite, zero on linear fields. The D
/// components of lambda lie together and do not see each other.
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

  /// Entries of a component's diagonal.
  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd diagonal(neighbours_.size());
    for_each(neighbours_.size(), [&](std::int64_t a) {
      double sum = 0;
      Vec<D> lean = Vec<D>::Zero();
      over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R) {
        sum += 2 * w - w * w * R.dot(inverse_moment_[b] * R);
        lean += w * R;
      });
      diagonal[a] = sum - lean.dot(inverse_moment_[a] * lean);
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

  /// use(b, omega_ab, X_b - X_a) for all neighbours of a.
  template <class Use>
  void over_edges(std::int64_t a, Use&& use) const {
    for (std::int64_t e = neighbours_.row[a]; e < neighbours_.row[a + 1]; ++e) {
      const std::int32_t b = neighbours_.column[e];
      const Vec<D> R = (X_[b] - X_[a]).template head<D>();
      use(b, omega_[e], R);
    }
  }

  std::int64_t particles() const { return neighbours_.size(); }
  std::int64_t count(std::int64_t a) const { return neighbours_.count(a); }
  std::span<const Vec3> positions() const { return X_; }
  const Mat<D>& inverse_moment(std::int64_t a) const { return inverse_moment_[a]; }

 private:
  std::span<const Vec3> X_;
  const Neighbours& neighbours_;
  std::vector<double> omega_;
  std::vector<Mat<D>> inverse_moment_;
  mutable std::vector<Mat<D>> m_;
};

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
