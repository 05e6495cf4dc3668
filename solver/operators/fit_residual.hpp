/// What the best linear fits around all particles leave of a field, as a linear operator.
#pragma once

#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/operators/gradient.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tessera::solver {

/// A vector for each of many particles (or other unknowns), one a column. In space each has a fourth
/// component that stays zero: four numbers are what the processor takes at once.
template <int D>
using Field = Eigen::Matrix<double, D == 3 ? 4 : D, Eigen::Dynamic>;

/// lambda -> sum_a delta_ab - sum_c delta_bc with delta_ab = omega_ab (lambda_b - lambda_a - m_a . (X_b -
/// X_a)) and m_a the slope of the best fit: symmetric, positive semidefinite, zero on linear fields. The
/// components of lambda do not see each other.
template <int D>
class FitResidual {
 public:
  FitResidual(std::span<const Vec3> X, const Neighbours& neighbours, const Gradient<D>& gradient)
      : X_(X), neighbours_(neighbours), omega_(gradient.omega), inverse_moment_(gradient.inverse_moment),
        m_(X.size()) {}

  /// result = this lambda.
  void multiply(const Field<D>& lambda, Field<D>& result) {
    fit(lambda);
    for_each(particles(), [&](std::int64_t a) {
      const Value here = lambda.col(a);
      const Slope m = m_[a];
      Value sum = Value::Zero();
      over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R) {
        Value left = 2 * (here - lambda.col(b));
        for (int c = 0; c < D; ++c)
          left += R[c] * (m.col(c) + m_[b].col(c));
        sum += w * left;
      });
      result.col(a) = sum;
    });
  }

  /// Entries of a component's diagonal.
  std::vector<double> diagonal() const {
    std::vector<double> diagonal(X_.size());
    for_each(particles(), [&](std::int64_t a) {
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

  /// Adds the change of lambda to the operators.
  void correct(Gradient<D>& gradient, const Field<D>& lambda) {
    fit(lambda);
    for_each(particles(), [&](std::int64_t a) {
      gradient.anchor[a].col(1) += lambda.col(a);
      gradient.B[a] -= m_[a].template topRows<D>();
    });
  }

  /// use(b, omega_ab, X_b - X_a) for all neighbours of a.
  template <class Use>
  void over_edges(std::int64_t a, Use&& use) const {
    for (std::int64_t e = neighbours_.row[a]; e < neighbours_.row[a + 1]; ++e) {
      const std::int32_t b = neighbours_.column[e];
      const Vec<D> R = (X_[b] - X_[a]).template head<D>();
      use(b, static_cast<double>(omega_[e]), R);
    }
  }

  std::int64_t particles() const { return neighbours_.size(); }
  std::span<const Vec3> positions() const { return X_; }

 private:
  static constexpr int components = Field<D>::RowsAtCompileTime;
  using Value = Eigen::Matrix<double, components, 1>;
  using Slope = Eigen::Matrix<double, components, D>;

  /// Slopes m_a of the best linear fit to lambda around every particle.
  void fit(const Field<D>& lambda) {
    for_each(particles(), [&](std::int64_t a) {
      const Value here = lambda.col(a);
      Slope sum = Slope::Zero();
      over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R) {
        const Value rise = w * (lambda.col(b) - here);
        for (int c = 0; c < D; ++c)
          sum.col(c) += R[c] * rise;
      });
      m_[a].noalias() = sum * inverse_moment_[a];
    });
  }

  std::span<const Vec3> X_;
  const Neighbours& neighbours_;
  std::span<const float> omega_;
  std::span<const Mat<D>> inverse_moment_;
  std::vector<Slope> m_; ///< of the field last fitted
};

} // namespace tessera::solver
