/// What a step of Heun's method does to one mode, and where it lets none grow.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace tessera::solver {

using Complex = std::complex<double>;

/// Factor by which a step multiplies a mode of du/dt = lambda u, with z = lambda dt, (4.37).
inline Complex heun_amplification(Complex z) {
  return 1.0 + z + 0.5 * z * z;
}

/// |heun_amplification(z)|^2 - 1, without the loss of digits near z = 0.
inline double heun_growth(Complex z) {
  const double delta = -z.real(), omega = z.imag();
  const double a = delta * (1 - 0.5 * delta); // 1 - a + b is the real part, b = -omega^2 / 2
  const double omega2 = omega * omega;
  // (1 - a - omega2/2)^2 + omega2 (1 - delta)^2 - 1, with (1 - delta)^2 = 1 - 2a.
  return a * (a - 2) - a * omega2 + 0.25 * omega2 * omega2;
}

/// The upper half of the closed curve |heun_amplification(z)| = 1, from z = 0 to z = -2.
inline std::vector<Complex> heun_region(std::size_t points) {
  std::vector<Complex> edge;
  for (std::size_t i = 0; i < points; ++i) {
    const double theta = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points - 1);
    const Complex root = std::sqrt(2.0 * std::polar(1.0, theta) - 1.0);
    edge.push_back(theta <= std::numbers::pi ? -1.0 + root : -1.0 - root);
  }
  edge.front() = 0;
  edge.back() = -2;
  return edge;
}

/// The same of Verlet's step with its dissipation half a step behind, for modes that swing: with
/// lambda^2 + delta lambda + omega^2 = 0 the bound (omega dt)^2 + 2 delta dt <= 4 is |z - 2|^2 <= 8.
inline std::vector<Complex> verlet_region(std::size_t points) {
  std::vector<Complex> edge;
  for (std::size_t i = 0; i < points; ++i) {
    const double theta =
        std::numbers::pi * (0.75 + 0.25 * static_cast<double>(i) / static_cast<double>(points - 1));
    edge.push_back(2.0 + std::polar(2 * std::numbers::sqrt2, theta));
  }
  return edge;
}

} // namespace tessera::solver
