/// A preconditioner for fit residuals, whose slow modes bend over the whole body.
#pragma once

#include "solver/operators/fit_residual.hpp"

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace tessera::solver {

/// One over the diagonal, plus the exact solution among fields that are linear in each box of a grid of some
/// particles a side: the number of iterations then hardly grows with the body.
template <int D>
class TwoLevel {
 public:
  TwoLevel& compute(const FitResidual<D>& K);

  template <class Rhs>
  Eigen::VectorXd solve(const Rhs& r) const {
    return solved(r);
  }
  Eigen::ComputationInfo info() const { return coarse_.info(); }

 private:
  static constexpr int functions = D + 1; ///< of a box: 1 and X

  Eigen::VectorXd solved(const Eigen::VectorXd& r) const;

  Eigen::VectorXd inverse_diagonal_;
  std::vector<std::int32_t> box_;                          ///< of every particle
  std::vector<Eigen::Matrix<double, functions, 1>> value_; ///< of its box's functions at every particle
  std::int64_t boxes_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarse_;
};

} // namespace tessera::solver
