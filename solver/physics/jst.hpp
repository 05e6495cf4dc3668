/// Jameson-Schmidt-Turkel dissipation, (3.83)-(3.89): D2 = eps2 c Delta lap(U), D4 = -eps4 c Delta^3 lap(lap
/// U).
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/operators/laplacian.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace tessera::solver {

/// kappa4, falling linearly from `elastic` to `plastic` while the plastic strain grows from 0 to `strain`,
/// (5.6); constant where both are equal.
struct Kappa4 {
  double elastic = 1.0 / 8;
  double plastic = 1.0 / 8;
  double strain = 1;

  static Kappa4 constant(double value) { return {value, value, 1}; }
  bool ramped() const { return plastic != elastic; }
  double at(double plastic_strain) const {
    return elastic + (plastic - elastic) * std::min(plastic_strain / strain, 1.0);
  }
};

/// Of the linear momentum. c is the local pressure wave speed, Delta the smallest particle distance.
template <int D>
struct Jst {
  static constexpr bool active = true, of_J = false;

  Laplacian laplacian;
  double delta; ///< Delta, m
  Kappa4 kappa4;
  double kappa2 = 0;              ///< of the shock term; 0: no sensor, no array
  double pressure_floor;          ///< Pa: pressures below it are no shock's
  std::vector<double> epsilon4{}; ///< kappa4 of every particle; the shock term takes its part off
  std::vector<double> epsilon2{}; ///< kappa2 times the largest sensor among the neighbours; empty without
  std::vector<Vec<D>> lap_p{};    ///< lap p, kg/(m^4 s)

  void allocate(std::size_t n) {
    epsilon4.assign(n, kappa4.elastic);
    if (kappa2 > 0)
      epsilon2.assign(n, 0.0);
    lap_p.assign(n, Vec<D>::Zero());
  }

  /// The undivided coefficients of c lap U and of -c lap(lap U) at particle a: m and m^3.
  double second(std::int64_t a) const { return epsilon2.empty() ? 0 : epsilon2[a] * delta; }
  double fourth(std::int64_t a) const {
    const double epsilon = epsilon2.empty() ? epsilon4[a] : std::max(0.0, epsilon4[a] - epsilon2[a]);
    return epsilon * delta * delta * delta;
  }
};

/// Of the linear momentum and of the volume map.
template <int D>
struct JstWithJ : Jst<D> {
  static constexpr bool of_J = true;

  double kappa4_J;              ///< of the volume map
  std::vector<double> lap_J{};  ///< 1/m^2
  std::vector<double> rate_J{}; ///< D^J, 1/s

  void allocate(std::size_t n) {
    Jst<D>::allocate(n);
    lap_J.assign(n, 0.0);
    rate_J.assign(n, 0.0);
  }
  double fourth_J(std::int64_t a) const {
    const double epsilon = this->epsilon2.empty() ? kappa4_J : std::max(0.0, kappa4_J - this->epsilon2[a]);
    return epsilon * this->delta * this->delta * this->delta;
  }
};

/// For scenes that ask for none: no weights, no arrays, no loop.
struct NoDissipation {
  static constexpr bool active = false, of_J = false;
  void allocate(std::size_t) {}
};

/// epsilon2 of every particle from its pressures (Pa): kappa2 times the largest sensor (3.87) of itself and
/// its neighbours. The sensor |sum_b l_ab (pr_b - pr_a)| / sum_b |l_ab| (|pr_b| + |pr_a| + floor) is a second
/// difference of the pressure: at most 1, of order one at a jump, of second order in the spacing where the
/// pressure is smooth. Absolute values, because a solid's pressure changes its sign where there is no shock.
template <int D>
void sense_shocks(Jst<D>& jst, const Neighbours& neighbours, std::span<const double> pressure) {
  const Laplacian& lap = jst.laplacian;
  std::vector<double> sensor(pressure.size());
  for_each(neighbours.size(), [&](std::int64_t a) {
    double difference = 0, scale = 0;
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
      const std::int32_t b = neighbours.column[e];
      difference += lap.l[e] * (pressure[b] - pressure[a]);
      scale += std::abs(lap.l[e]) * (std::abs(pressure[b]) + std::abs(pressure[a]) + jst.pressure_floor);
    }
    sensor[a] = std::abs(difference) / scale;
  });
  for_each(neighbours.size(), [&](std::int64_t a) {
    double largest = sensor[a];
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e)
      largest = std::max(largest, sensor[neighbours.column[e]]);
    jst.epsilon2[a] = jst.kappa2 * largest;
  });
}

} // namespace tessera::solver
