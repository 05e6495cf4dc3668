/// A preconditioner for fit residuals: corrections of all wavelengths at once, each by its own stiffness.
#pragma once

#include "solver/operators/fit_residual.hpp"

#include <Eigen/SparseCore>

#include <vector>

namespace tessera::solver {

/// A fit residual resists a field that varies over a length s with about (h/s)^4 of what it opposes to one
/// that varies from particle to particle, h apart, as a plate resists bending. One over its diagonal suits
/// the roughest fields alone. To it is added, for grids of spacing s, 2 s, 4 s ... up to the body's size,
///   B_l D_l^-1 B_l^T
/// with B_l the grid's quadratic B-splines at the particles and D_l about the stiffness of each. Their slopes
/// are continuous, so they bend without kinks; each is a sum of splines of the next finer grid, so all go
/// from grid to grid to the finest. Nothing is assembled or factorised: the work is proportional to the
/// particles, the number of iterations hardly grows with them. (A multilevel preconditioner after Bramble,
/// Pasciak and Xu, Math. Comp. 55, 1990.)
template <int D>
class SplineLevels {
 public:
  explicit SplineLevels(const FitResidual<D>& K);

  /// z = the preconditioner times r: symmetric and positive definite.
  void apply(const Field<D>& r, Field<D>& z);

 private:
  /// Row by row: what each finer unknown takes of the coarser ones.
  using Interpolation = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  struct Level {
    Interpolation up;   ///< from this grid's splines to the next finer's, to the particles from the finest
    Interpolation down; ///< its transpose
    std::vector<double> D_inverse;
    Field<D> force, move; ///< of the splines, while it is applied
  };

  std::vector<double> inverse_diagonal_;
  std::vector<Level> levels_; ///< from the finest
};

} // namespace tessera::solver
