/// The strain measures of the mixed formulation, by value.
#pragma once

#include "core/tensor.hpp"

namespace tessera::solver {

/// Deformation gradient, its cofactor and its determinant: independent where a formulation evolves them.
struct Strain {
  Mat3 F;   ///< fibre map
  Mat3 H;   ///< area map
  double J; ///< volume map

  /// H and J taken from F.
  static Strain of(const Mat3& F) {
    const Mat3 H = cofactor(F);
    return {F, H, F.row(0).dot(H.row(0))};
  }
};

/// F in three dimensions: plane strain leaves the thickness as it is.
inline Mat3 embed(const Mat<3>& F) {
  return F;
}
inline Mat3 embed(const Mat<2>& F) {
  Mat3 F3 = Mat3::Identity();
  F3.topLeftCorner<2, 2>() = F;
  return F3;
}

/// Squares of the principal stretches of F, the smallest first.
inline Vec3 squared_stretches(const Mat3& F) {
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(F.transpose() * F, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues();
}

} // namespace tessera::solver
