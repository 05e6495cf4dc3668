/// Symmetric second-order tensors in space by their six entries.
///
/// Inlined whatever their size: a tensor handed over through memory is written entry by entry and read by
/// pairs, for which the reader has to wait (twice the time of a stress).
#pragma once

#include "core/tensor.hpp"

namespace tessera {

struct Symmetric {
  double xx, yy, zz, yz, zx, xy;

  static constexpr Symmetric identity() { return {1, 1, 1, 0, 0, 0}; }

  double trace() const { return xx + yy + zz; }
  [[gnu::always_inline]] Mat3 matrix() const {
    Mat3 S;
    S << xx, xy, zx, xy, yy, yz, zx, yz, zz;
    return S;
  }
  bool operator==(const Symmetric&) const = default;
};

[[gnu::always_inline]] inline Symmetric operator+(const Symmetric& A, const Symmetric& B) {
  return {A.xx + B.xx, A.yy + B.yy, A.zz + B.zz, A.yz + B.yz, A.zx + B.zx, A.xy + B.xy};
}
[[gnu::always_inline]] inline Symmetric operator*(double s, const Symmetric& A) {
  return {s * A.xx, s * A.yy, s * A.zz, s * A.yz, s * A.zx, s * A.xy};
}
/// A + s I.
[[gnu::always_inline]] inline Symmetric add_isotropic(const Symmetric& A, double s) {
  return {A.xx + s, A.yy + s, A.zz + s, A.yz, A.zx, A.xy};
}

/// dev A, by differences of its entries: as accurate as they where they are nearly alike.
[[gnu::always_inline]] inline Symmetric deviator(const Symmetric& A) {
  const double xy = (A.xx - A.yy) / 3, yz = (A.yy - A.zz) / 3, zx = (A.zz - A.xx) / 3;
  return {xy - zx, yz - xy, zx - yz, A.yz, A.zx, A.xy};
}

/// A : B.
[[gnu::always_inline]] inline double inner(const Symmetric& A, const Symmetric& B) {
  return A.xx * B.xx + A.yy * B.yy + A.zz * B.zz + 2 * (A.yz * B.yz + A.zx * B.zx + A.xy * B.xy);
}

/// A A.
[[gnu::always_inline]] inline Symmetric square(const Symmetric& A) {
  return {A.xx * A.xx + A.xy * A.xy + A.zx * A.zx, A.xy * A.xy + A.yy * A.yy + A.yz * A.yz,
          A.zx * A.zx + A.yz * A.yz + A.zz * A.zz, A.zx * A.xy + A.yz * (A.yy + A.zz),
          A.xy * A.yz + A.zx * (A.xx + A.zz),      A.zx * A.yz + A.xy * (A.xx + A.yy)};
}

/// A B^T where that is symmetric.
[[gnu::always_inline]] inline Symmetric symmetric_product(const Mat3& A, const Mat3& B) {
  return {A.row(0).dot(B.row(0)), A.row(1).dot(B.row(1)), A.row(2).dot(B.row(2)),
          A.row(1).dot(B.row(2)), A.row(2).dot(B.row(0)), A.row(0).dot(B.row(1))};
}

[[gnu::always_inline]] inline Vec3 operator*(const Symmetric& S, const Vec3& v) {
  return {S.xx * v[0] + S.xy * v[1] + S.zx * v[2], S.xy * v[0] + S.yy * v[1] + S.yz * v[2],
          S.zx * v[0] + S.yz * v[1] + S.zz * v[2]};
}

/// F S F^T.
[[gnu::always_inline]] inline Symmetric transform(const Mat3& F, const Symmetric& S) {
  const Vec3 x = F.row(0), y = F.row(1), z = F.row(2), Sx = S * x, Sy = S * y, Sz = S * z;
  return {x.dot(Sx), y.dot(Sy), z.dot(Sz), y.dot(Sz), z.dot(Sx), x.dot(Sy)};
}

} // namespace tessera
