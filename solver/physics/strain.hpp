/// The strain measures of the mixed formulation, by value and as fields.
#pragma once

#include "core/symmetric.hpp"
#include "core/tensor.hpp"
#include "solver/physics/isotropic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace tessera::solver {

/// Deformation gradient, its cofactor and its determinant: independent where a formulation evolves them.
struct Strain {
  Mat3 F;   ///< fibre map
  Mat3 H;   ///< area map
  double J; ///< volume map

  /// H and J taken from F.
  [[gnu::always_inline]] static Strain of(const Mat3& F) { return {F, cofactor(F), determinant(F)}; }
};

/// b = F F^T.
[[gnu::always_inline]] inline Symmetric left_cauchy_green(const Mat3& F) {
  return symmetric_product(F, F);
}

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

  [[gnu::always_inline]] Strain operator[](std::int64_t a) const {
    const auto i = static_cast<std::size_t>(a);
    const Mat3 F_a = embed(F[i]);
    return {F_a, H.empty() ? cofactor(F_a) : H[i], J.empty() ? determinant(F_a) : J[i]};
  }
};

/// J^(-2/3); half as dear as by the cube root.
inline double isochoric_factor(double J) {
  return std::exp(-1.0 / 3 * std::log(J * J));
}

/// Squares of the principal stretches of F, the smallest first.
inline Vec3 squared_stretches(const Mat3& F) {
  const Deviation b(left_cauchy_green(F));
  const Vec3 x = PrincipalValues(b).values();
  return b.mean * (1 + Vec3(std::min(x[0], x[2]), x[1], std::max(x[0], x[2])).array());
}

} // namespace tessera::solver
