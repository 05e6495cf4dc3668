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

/// Squares of the principal stretches of many F, the smallest first, eight at a time: by what
/// PrincipalValues explains, in numbers of eight particles each.
template <int D>
void squared_stretches(std::span<const Mat<D>> many, std::span<Vec3> squared) {
  constexpr int together = 8;
  using Numbers = Eigen::Array<double, together, 1>;
  for (std::size_t first = 0; first < many.size(); first += together) {
    Numbers F[3][3], X[3][3], Q[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < together; ++k) {
          const Mat<D>& F_k = many[std::min(first + k, many.size() - 1)];
          F[i][j][static_cast<int>(k)] = i < D && j < D ? F_k(i % D, j % D) : double(i == j);
        }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        X[i][j] = X[j][i] = F[i][0] * F[j][0] + F[i][1] * F[j][1] + F[i][2] * F[j][2];
    const Numbers mean = (X[0][0] + X[1][1] + X[2][2]) / 3, inverse_mean = 1 / mean;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        X[i][j] = X[j][i] = (i == j ? Numbers(X[i][j] - mean) : X[i][j]) * inverse_mean;
    const auto inner = [](const Numbers(&A)[3][3], const Numbers(&B)[3][3]) -> Numbers {
      return A[0][0] * B[0][0] + A[1][1] * B[1][1] + A[2][2] * B[2][2] +
             2 * (A[1][0] * B[1][0] + A[2][0] * B[2][0] + A[2][1] * B[2][1]);
    };
    const Numbers h = 0.5 * inner(X, X), inverse_XX = 0.5 / h.max(1e-60);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        Q[i][j] = X[i][0] * X[0][j] + X[i][1] * X[1][j] + X[i][2] * X[2][j];
    const Numbers d = inner(X, Q) / 3;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) {
        Q[i][j] -= 3 * d * inverse_XX * X[i][j]; // T
        if (i == j)
          Q[i][j] -= 2.0 / 3 * h;
      }
    const Numbers size_X = (2 * h).sqrt(), size_T = inner(Q, Q).sqrt();
    const Numbers cos3 = std::sqrt(54.0) * d.abs() * inverse_XX / size_X.max(1e-30);
    const Numbers sin3 = std::sqrt(6.0) * size_T * inverse_XX;
    Numbers c = std::sqrt(0.75) + (1 - std::sqrt(0.75)) * cos3;
    for (int i = 0; i < 3; ++i)
      c -= (c * (4 * c * c - 3) - cos3) / (12 * c * c - 3);
    const Numbers s = sin3 / (4 * c * c - 1), size = std::sqrt(2.0 / 3) * size_X;
    // The values of X or, where d is negative, of -X: the largest in size, and two of the other sign.
    const Numbers most = size * c, middle = size * (std::sqrt(0.75) * s - 0.5 * c),
                  least = size * (-std::sqrt(0.75) * s - 0.5 * c);
    const Numbers smallest = (d < 0).select(-most, least), largest = (d < 0).select(-least, most);
    const Numbers between = (d < 0).select(-middle, middle);
    for (std::size_t k = 0; k < std::min<std::size_t>(together, many.size() - first); ++k) {
      const auto i = static_cast<int>(k);
      squared[first + k] = mean[i] * (1 + Vec3(smallest[i], between[i], largest[i]).array());
    }
  }
}

/// Those of one F.
inline Vec3 squared_stretches(const Mat3& F) {
  Vec3 squared;
  squared_stretches<3>(std::span(&F, 1), std::span(&squared, 1));
  return squared;
}

} // namespace tessera::solver
