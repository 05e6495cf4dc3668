#include "solver/time/advection.hpp"

#include "solver/operators/spline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>

namespace tessera::solver {
namespace {

/// m-th derivative by r of (3.52) with alpha = 1/8 at r = distance, from the right; support = 2 h = per_side.
double quintic_derivative(int m, double distance, int per_side) {
  const double h = 0.5 * per_side;
  double factor = 1.0 / 8 / std::pow(h, m + 1);
  for (int i = 0; i < m; ++i)
    factor *= -(QuinticPowers::N - i);
  double sum = 0;
  for (std::size_t k = 0; k < QuinticPowers::knot.size(); ++k) {
    const double knot = 2 * QuinticPowers::knot[k]; // (3.52) is a function of r / h
    if (knot > distance / h)
      sum += QuinticPowers::factor[k] * std::pow(knot - distance / h, QuinticPowers::N - m);
  }
  return factor * sum;
}

/// What the longest waves bear: |z|^2 - 1 = (courant Phi)^4/4 - 2 kappa4 courant Phi^4 + ...
double long_wave_limit(const AdvectionScheme& scheme) {
  return 2 * std::cbrt(scheme.kappa4);
}

/// The fastest growth of any wave but the very longest, where the leading terms say more.
struct Growth {
  double most, Phi;
};
Growth fastest_growth(const AdvectionScheme& scheme, double courant) {
  constexpr int waves = 4000;
  constexpr double longest = 0.02;
  Growth growth{-1, 0};
  for (int i = 0; i <= waves; ++i) {
    const double Phi = longest + (std::numbers::pi - longest) * i / waves;
    const double here = heun_growth(courant * advection_eigenvalue(scheme, Phi));
    if (here > growth.most)
      growth = {here, Phi};
  }
  return growth;
}

} // namespace

std::vector<KernelRow> kernel_table(int per_side) {
  std::vector<KernelRow> rows;
  double total = 0, slopes = 0, squares = 0, rough = 0;
  for (int j = -per_side; j <= per_side; ++j) {
    KernelRow row{j, {}, {}};
    for (int m = 0; m < 5; ++m) {
      const bool odd = m % 2 == 1;
      const double sign = odd && j > 0 ? -1 : 1; // x_a - x_b = -j dx
      // No negative zeros.
      row.derivative[static_cast<std::size_t>(m)] = sign * quintic_derivative(m, std::abs(j), per_side) + 0.0;
    }
    total += row.derivative[0];
    slopes += j * row.derivative[1];
    if (j != 0) {
      squares += 0.5 * j * j * row.derivative[2];
      rough += row.derivative[2];
    }
    rows.push_back(row);
  }
  for (KernelRow& row : rows)
    row.corrected = {row.derivative[0] / total, row.derivative[1] / slopes,
                     (row.offset == 0 ? -rough : row.derivative[2]) / squares};
  return rows;
}

Complex advection_eigenvalue(const AdvectionScheme& scheme, double Phi) {
  if (scheme.per_side == 2) {
    const double rough = std::cos(Phi) - 1;
    return {-4 * scheme.kappa4 * rough * rough, -std::sin(Phi)};
  }
  return {scheme.kappa4 * (-std::cos(3 * Phi) / 5 - 4 * std::cos(2 * Phi) / 5 + 5 * std::cos(Phi) - 4),
          -(std::sin(2 * Phi) + 15 * std::sin(Phi)) / 17};
}

Complex advection_amplification(const AdvectionScheme& scheme, double courant, double Phi) {
  return heun_amplification(courant * advection_eigenvalue(scheme, Phi));
}

double dispersion_error(const AdvectionScheme& scheme, double courant, double Phi) {
  return Phi == 0 ? 1 : -std::arg(advection_amplification(scheme, courant, Phi)) / (courant * Phi);
}

double largest_courant(const AdvectionScheme& scheme) {
  constexpr double round_off = 1e-13;
  double stable = 0, unstable = long_wave_limit(scheme);
  if (fastest_growth(scheme, unstable).most <= round_off)
    return unstable;
  while (unstable - stable > 1e-12) {
    const double middle = 0.5 * (stable + unstable);
    (fastest_growth(scheme, middle).most <= round_off ? stable : unstable) = middle;
  }
  return stable;
}

double first_to_grow(const AdvectionScheme& scheme) {
  const double limit = largest_courant(scheme);
  return limit == long_wave_limit(scheme) ? 0 : fastest_growth(scheme, limit * (1 + 1e-6)).Phi;
}

} // namespace tessera::solver
