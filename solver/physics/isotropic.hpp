/// Isotropic functions of symmetric tensors in closed form, without principal axes: every one of them is a
/// polynomial of second degree in its argument (Cayley and Hamilton), here in orthogonal parts that stay
/// accurate where principal values meet.
#pragma once

#include "core/symmetric.hpp"

#include <array>
#include <cmath>

namespace tessera::solver {

/// A symmetric tensor without trace, and what its powers come from.
struct Deviator {
  Symmetric X;
  Symmetric Q;        ///< dev X^2
  double half_square; ///< h = X:X / 2
  double determinant; ///< d, in X^3 = h X + d I

  [[gnu::always_inline]] explicit Deviator(const Symmetric& traceless) : X(traceless) {
    const Symmetric X2 = square(X);
    half_square = 0.5 * X2.trace();
    determinant = inner(X, X2) / 3;
    Q = add_isotropic(X2, -2.0 / 3 * half_square);
  }
};

/// b = mean (I + X) of a positive definite b.
struct Deviation : Deviator {
  double mean; ///< tr b / 3

  [[gnu::always_inline]] explicit Deviation(const Symmetric& b) : Deviation(b, b.trace() / 3) {}

  double relative_determinant() const { return 1 - half_square + determinant; } ///< det b / mean^3

 private:
  [[gnu::always_inline]] Deviation(const Symmetric& b, double b_mean)
      : Deviator(1 / b_mean * deviator(b)), mean(b_mean) {}
};

/// Principal values of a deviator and the functions of them.
///
/// I, X and T = Q - (X:Q / X:X) X are orthogonal and commute; f(X) is its projection on them, taken from the
/// principal values of each. The principal values of X are sqrt(2/3) |X| cos(theta - 2 pi i / 3), those of T
/// sqrt(2/3) |T| sin(...), with cos 3 theta and sin 3 theta from X:Q and |T|: both, so that nothing is lost
/// where two principal values meet.
class PrincipalValues {
 public:
  explicit PrincipalValues(const Deviator& deviator) : X_(deviator.X) {
    const double h = deviator.half_square, d = deviator.determinant;
    if (!(h > 1e-60)) { // no deviator next to I; its powers would underflow
      inverse_XX_ = 0;
      return;
    }
    inverse_XX_ = 0.5 / h;
    T_ = deviator.Q + (-3 * d * inverse_XX_) * X_;
    const double TT = inner(T_, T_), size_X = std::sqrt(2 * h), size_T = std::sqrt(TT);
    inverse_TT_ = TT > 0 ? 1 / TT : 0;

    // theta of 0 to 30 degrees: that of -X where X:Q is negative. Newton's method for 4 c^3 - 3 c = cos 3
    // theta from the chord, 5e-3 off at most: then 4e-5, 2e-9, rounding.
    const double cos3 = std::sqrt(54.0) * std::abs(d) * inverse_XX_ / size_X;
    const double sin3 = std::sqrt(6.0) * size_T * inverse_XX_;
    double c = std::sqrt(0.75) + (1 - std::sqrt(0.75)) * cos3;
    for (int i = 0; i < 3; ++i)
      c -= (c * (4 * c * c - 3) - cos3) / (12 * c * c - 3);
    const double s = sin3 / (4 * c * c - 1);
    const double X = std::copysign(std::sqrt(2.0 / 3) * size_X, d), T = std::sqrt(2.0 / 3) * size_T;
    const double cos120 = -0.5, sin120 = std::sqrt(0.75);
    x_ = X * Vec3(c, cos120 * c + sin120 * s, cos120 * c - sin120 * s);
    t_ = T * Vec3(s, cos120 * s - sin120 * c, cos120 * s + sin120 * c);
  }

  /// Of X; the middle one in the middle.
  const Vec3& values() const { return x_; }

  /// The tensor with the principal values f on the axes of X, in the order of values().
  Symmetric function(const Vec3& f) const {
    return add_isotropic(f.dot(x_) * inverse_XX_ * X_ + f.dot(t_) * inverse_TT_ * T_, f.mean());
  }

 private:
  Symmetric X_, T_{};
  double inverse_XX_, inverse_TT_ = 0;
  Vec3 x_ = Vec3::Zero(), t_ = Vec3::Zero();
};

/// The upper half of the 24 points on -1/2 to 1/2, and their weights.
struct GaussLegendre {
  using Points = Eigen::Array<double, 12, 1>;
  static Points points() { return 0.5 * Eigen::Map<const Points>(x.data()); }
  static Points weights() { return 0.5 * Eigen::Map<const Points>(w.data()); }

 private: // on -1 to 1
  static constexpr std::array x = {0.06405689286260563, 0.1911188674736163, 0.3150426796961634,
                                   0.4337935076260451,  0.5454214713888396, 0.6480936519369755,
                                   0.7401241915785544,  0.820001985973903,  0.8864155270044011,
                                   0.9382745520027328,  0.9747285559713095, 0.9951872199970213};
  static constexpr std::array w = {0.12793819534675216, 0.1258374563468283,   0.12167047292780339,
                                   0.1155056680537256,  0.10744427011596563,  0.09761865210411388,
                                   0.08619016153195327, 0.0733464814110803,   0.05929858491543678,
                                   0.04427743881741981, 0.028531388628933663, 0.0123412297999872};
};

/// The rare ways of the two functions below: for any principal values.
[[gnu::noinline]] inline Symmetric log_deviator_by_principal_values(const Deviation& b) {
  const PrincipalValues principal(b);
  const Vec3 log_b = principal.values().unaryExpr([](double x) { return std::log1p(x); });
  return principal.function(log_b.array() - log_b.mean());
}
[[gnu::noinline]] inline Symmetric exponential_by_principal_values(const Deviator& A) {
  const PrincipalValues principal(A);
  return principal.function(principal.values().array().exp());
}

/// dev log b. The logarithm is the integral of (b - I)(I + t (b - I))^-1 over t from 0 to 1, whose deviator
/// is that of (X - t Q) / (1 - h t^2 + d t^3): by 24 points of Gauss and Legendre, to rounding while
/// principal values are not further apart than about 0.13 to 3 of the mean; else by principal values.
[[gnu::always_inline]] inline Symmetric log_deviator(const Deviation& b) {
  if (!(b.relative_determinant() > 0.3))
    return log_deviator_by_principal_values(b);
  const double h = b.half_square, d = b.determinant;
  const auto integrand = [&](const GaussLegendre::Points& t) -> GaussLegendre::Points {
    return GaussLegendre::weights() / (1 - t * t * (h - d * t));
  };
  const GaussLegendre::Points above = 0.5 + GaussLegendre::points(), below = 0.5 - GaussLegendre::points();
  const GaussLegendre::Points f = integrand(above), g = integrand(below);
  return (f + g).sum() * b.X + -(above * f + below * g).sum() * b.Q;
}

/// exp A: by its series, 9 terms to rounding while no principal value is beyond 0.11; else by principal
/// values. With S_k the sum of all products of k principal values, repeated ones too: S_k = h S_(k-2) + d
/// S_(k-3), A^k is S_(k-2) A^2 + S_(k-1) A + d S_(k-3) I.
[[gnu::always_inline]] inline Symmetric exponential(const Deviator& A) {
  const double h = A.half_square, d = A.determinant;
  if (!(h < 0.01))
    return exponential_by_principal_values(A);
  constexpr std::size_t terms = 9;
  constexpr auto inverse_factorial = [] {
    std::array<double, terms + 3> inverse{1};
    for (std::size_t k = 1; k < inverse.size(); ++k)
      inverse[k] = inverse[k - 1] / static_cast<double>(k);
    return inverse;
  }();
  std::array<double, terms> S{1, 0, h};
  for (std::size_t k = 3; k < terms; ++k)
    S[k] = h * S[k - 2] + d * S[k - 3];
  double of_I = 0, of_X = 0, of_X2 = 0;
  for (std::size_t k = terms; k-- > 0;) { // the small ones first
    of_I += d * S[k] * inverse_factorial[k + 3];
    of_X += S[k] * inverse_factorial[k + 1];
    of_X2 += S[k] * inverse_factorial[k + 2];
  }
  return add_isotropic(of_X * A.X + of_X2 * A.Q, 1 + (of_I + 2.0 / 3 * h * of_X2));
}

} // namespace tessera::solver
