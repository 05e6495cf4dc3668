/// Kernels made of truncated powers: cubic, quartic and quintic spline of support radius s.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace tessera::solver {

/// sum_k c_k max(0, k - q)^N over the knots k in units of the support, largest first. The factors c_k make
/// the odd derivatives that the degree leaves free vanish at q = 0, the first one always.
struct CubicPowers { ///< the cubic B-spline
  static constexpr int N = 3;
  static constexpr std::array knot = {1.0, 0.5}, factor = {1.0, -4.0};
};
struct QuarticPowers { ///< the quartic B-spline, (3.51)
  static constexpr int N = 4;
  static constexpr std::array knot = {1.0, 0.6, 0.2}, factor = {1.0, -5.0, 10.0};
};
struct QuinticPowers { ///< two pieces, (3.52): not the B-spline, which has three
  static constexpr int N = 5;
  static constexpr std::array knot = {1.0, 0.5}, factor = {1.0, -16.0};
};

/// The kernel alpha sum_k c_k max(0, k - q)^N, q = r / s, in D dimensions: N - 1 continuous derivatives away
/// from its centre, N - 1 vanishing ones at its support.
template <int D, class Powers>
struct Spline {
  /// W, 1/m^D.
  static double value(double r, double s) { return alpha / power<D>(s) * sum<N>(r / s); }

  /// W'(r) / r: finite at r = 0, never positive.
  static double slope_over_r(double r, double s) { return -N * alpha / power<D + 2>(s) * sum_over_q(r / s); }

  /// Laplacian of W: W'' + (D - 1) W' / r.
  static double laplacian(double r, double s) {
    const double q = r / s;
    return N * alpha / power<D + 2>(s) * ((N - 1) * sum<N - 2>(q) - (D - 1) * sum_over_q(q));
  }

 private:
  static constexpr int N = Powers::N;
  static constexpr std::size_t pieces = Powers::knot.size();

  template <int n>
  static constexpr double power(double x) {
    if constexpr (n == 0)
      return 1;
    else
      return x * power<n - 1>(x);
  }

  template <int n>
  static double sum(double q) {
    double total = 0;
    for (std::size_t i = 0; i < pieces; ++i)
      if (Powers::knot[i] > q)
        total += Powers::factor[i] * power<n>(Powers::knot[i] - q);
    return total;
  }

  /// sum<N - 1>(q) / q. Within the innermost knot the sum vanishes with q: there as difference quotients,
  /// ((k - q)^n - k^n) / q = -sum_j (k - q)^j k^(n-1-j), which cancel nothing.
  static double sum_over_q(double q) {
    if (q >= Powers::knot.back())
      return sum<N - 1>(q) / q;
    double total = 0;
    for (std::size_t i = 0; i < pieces; ++i) {
      const double k = Powers::knot[i];
      double quotient = 0, power_of_k = 1;
      for (int j = 0; j < N - 1; ++j) { // Horner's scheme in k - q
        quotient = quotient * (k - q) + power_of_k;
        power_of_k *= k;
      }
      total -= Powers::factor[i] * quotient;
    }
    return total;
  }

  /// Of unit integral: that of q^(D-1) (k - q)^N over [0, k] is k^(N+D) (D-1)! N! / (N+D)!.
  static constexpr double normalisation() {
    double sphere = D == 1 ? 2 : 2 * (D - 1) * std::numbers::pi; // surface of the unit sphere
    for (int d = 0; d < D; ++d)
      sphere *= (d == 0 ? 1.0 : d) / (N + 1 + d);
    double total = 0;
    for (std::size_t i = 0; i < pieces; ++i)
      total += Powers::factor[i] * power<N + D>(Powers::knot[i]);
    return 1 / (sphere * total);
  }
  static constexpr double alpha = normalisation();
};

} // namespace tessera::solver
