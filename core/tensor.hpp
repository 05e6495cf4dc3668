/// Vectors and second-order tensors of dimension D, and the tensor algebra of the mixed formulation.
#pragma once

#include <Eigen/Dense>

namespace tessera {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;
template <int D>
using Mat = Eigen::Matrix<double, D, D>;
using Vec3 = Vec<3>;
using Mat3 = Mat<3>;

/// Tensor cross product (A x B)_iI = e_ijk e_IJK A_jJ B_kK; H = F x F / 2 is the cofactor of F.
inline Mat3 cross(const Mat3& A, const Mat3& B) {
  Mat3 C;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int I = 0; I < 3; ++I) {
      const int J = (I + 1) % 3, K = (I + 2) % 3;
      C(i, I) = A(j, J) * B(k, K) - A(j, K) * B(k, J) + A(k, K) * B(j, J) - A(k, J) * B(j, K);
    }
  }
  return C;
}

/// Cofactor of F: det(F) F^-T wherever F is regular, polynomial in F everywhere.
[[gnu::always_inline]] inline Mat3 cofactor(const Mat3& F) {
  Mat3 H;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int I = 0; I < 3; ++I) {
      const int J = (I + 1) % 3, K = (I + 2) % 3;
      H(i, I) = F(j, J) * F(k, K) - F(j, K) * F(k, J);
    }
  }
  return H;
}

[[gnu::always_inline]] inline double determinant(const Mat3& F) {
  return F.row(0).dot(cofactor(F).row(0));
}

} // namespace tessera
