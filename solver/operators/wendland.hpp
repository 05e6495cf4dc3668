/// Wendland's C2 kernel of support radius s.
#pragma once

#include <numbers>

namespace tessera::solver {

/// Wendland C2 kernel in D dimensions, (3.53)-(3.54): alpha (1 - q)^4 (1 + 4 q), q = r / s (D = 2, 3);
/// alpha (1 - q)^3 (1 + 3 q) for D = 1.
template <int D>
struct Wendland {
  /// Normalisation alpha for s = 1: 5/4, 7/pi, 21/(2 pi).
  static constexpr double alpha = D == 1 ? 1.25 : D == 2 ? 7 / std::numbers::pi : 10.5 / std::numbers::pi;

  /// W, 1/m^D.
  static double value(double r, double s) {
    const double q = r / s, u = 1 - q;
    if (u <= 0)
      return 0;
    return scale(s) * (D == 1 ? u * u * u * (1 + 3 * q) : u * u * u * u * (1 + 4 * q));
  }

  /// W'(r) / r: finite at r = 0, never positive; grad W = W'(r)/r (X_a - X_b).
  static double slope_over_r(double r, double s) {
    const double u = 1 - r / s;
    if (u <= 0)
      return 0;
    return -scale(s) / (s * s) * (D == 1 ? 12 * u * u : 20 * u * u * u);
  }

  /// Laplacian of W: W'' + (D - 1) W' / r.
  static double laplacian(double r, double s) {
    const double q = r / s, u = 1 - q;
    if (u <= 0)
      return 0;
    if constexpr (D == 1)
      return -12 * scale(s) / (s * s) * u * (1 - 3 * q);
    return -20 * scale(s) / (s * s) * u * u * ((1 - 4 * q) + (D - 1) * u);
  }

 private:
  static double scale(double s) { return alpha / (D == 1 ? s : D == 2 ? s * s : s * s * s); }
};

} // namespace tessera::solver
