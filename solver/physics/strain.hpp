/// The strain measures of the mixed formulation, by value and as fields.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <span>

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

/// A velocity gradient in three dimensions: nothing moves across the plane.
inline Mat3 embed_rate(const Mat<3>& G) {
  return G;
}
inline Mat3 embed_rate(const Mat<2>& G) {
  Mat3 G3 = Mat3::Zero();
  G3.topLeftCorner<2, 2>() = G;
  return G3;
}

/// The strains of all particles; H and J are empty where they are taken from F.
template <int D>
struct StrainFields {
  std::span<const Mat<D>> F;
  std::span<const Mat3> H;
  std::span<const double> J;

  Strain operator[](std::int64_t a) const {
    const auto i = static_cast<std::size_t>(a);
    Strain strain = Strain::of(embed(F[i]));
    if (!H.empty())
      strain.H = H[i];
    if (!J.empty())
      strain.J = J[i];
    return strain;
  }
};

/// Squares of the principal stretches of F, the smallest first.
inline Vec3 squared_stretches(const Mat3& F) {
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(F.transpose() * F, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues();
}

} // namespace tessera::solver
