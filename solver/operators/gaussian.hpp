/// The Gaussian kernel cut at its support radius s.
#pragma once

#include <cmath>
#include <numbers>

namespace tessera::solver {

/// alpha exp(-(r/h)^2), (3.49), cut at s = 3 h, of unit integral as cut. At the cut it is 1.2e-4 of its peak.
template <int D>
struct Gaussian {
  /// W, 1/m^D.
  static double value(double r, double s) {
    const double q = r / s;
    return q < 1 ? scale(s) * std::exp(-9 * q * q) : 0;
  }

  /// W'(r) / r: finite at r = 0, never positive.
  static double slope_over_r(double r, double s) { return -18 / (s * s) * value(r, s); }

  /// Laplacian of W: W'' + (D - 1) W' / r.
  static double laplacian(double r, double s) {
    const double q = r / s;
    return 18 / (s * s) * (18 * q * q - D) * value(r, s);
  }

 private:
  static double scale(double s) {
    // Integrals of exp(-t^2) over the ball of radius 3 in t = r / h.
    static const double line = std::sqrt(std::numbers::pi) * std::erf(3.0), edge = std::exp(-9.0);
    static const double integral = D == 1   ? line
                                   : D == 2 ? std::numbers::pi * (1 - edge)
                                            : std::numbers::pi * (line - 6 * edge);
    const double h = s / 3;
    return 1 / (integral * (D == 1 ? h : D == 2 ? h * h : h * h * h));
  }
};

} // namespace tessera::solver
