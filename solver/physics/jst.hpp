/// Jameson-Schmidt-Turkel dissipation, (3.83)-(3.89): D2 = eps2 c Delta lap(U), D4 = -eps4 c Delta^3 lap(lap
/// U).
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/operators/laplacian.hpp"
#include "solver/physics/dissipation.hpp"
#include "solver/physics/plastic_ramp.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace tessera::solver {

/// Of the linear momentum. c is the local pressure wave speed, Delta the smallest particle distance.
template <int D>
struct Jst : DissipationDefaults {
  static constexpr bool active = true, sweeps_first = true;
  static constexpr std::size_t edge_bytes = sizeof(double),
                               particle_bytes = 2 * sizeof(double) + sizeof(Vec<D>),
                               sensor_bytes = sizeof(double);

  Laplacian laplacian{};
  double delta = 1; ///< Delta, m
  Kappa4 kappa4{};
  double kappa2 = 0;              ///< of the shock term; 0: no sensor, no array
  double pressure_floor = 0;      ///< Pa: pressures below it are no shock's
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
  double fourth(std::int64_t a) const { return fourth(a, epsilon4[a]); }

  template <class Body>
  Vec<D> begin_first(const Body& body, std::int64_t a) const {
    return -laplacian.sum[a] * body.U.p[a];
  }
  template <class Body>
  void add_first(Vec<D>& lap, const Body& body, std::int64_t e, std::int32_t b) const {
    lap += laplacian.l[e] * body.U.p[b];
  }
  void end_first(const Vec<D>& lap, std::int64_t a) { lap_p[a] = lap; }

  template <class Body>
  Vec<D> begin_second(const Body&, std::int64_t a) const {
    return -laplacian.sum[a] * lap_p[a];
  }
  template <class Body>
  void add_second(Vec<D>& lap_lap, const Body&, std::int64_t, std::int64_t e, std::int32_t b) const {
    lap_lap += laplacian.l[e] * lap_p[b];
  }
  template <class Body>
  void end_second(const Vec<D>& lap_lap, Body& body, std::int64_t a) {
    body.R.p[a] += body.wave[a] * (second(a) * lap_p[a] - fourth(a) * lap_lap);
  }

  template <class Body>
  void advance(const Body& body) {
    if (kappa4.ramped())
      for_each(body.size(),
               [&](std::int64_t a) { epsilon4[a] = kappa4.at(body.material->equivalent_plastic_strain(a)); });
  }

  /// The sensor of the shock term, where there is one, from the mean normal stress in D dimensions.
  template <class Body>
  void sense(const Body& body) {
    if (epsilon2.empty())
      return;
    std::vector<double> pressure(body.V.size());
    for_each(body.size(), [&](std::int64_t a) {
      const Mat<D>& F = body.strains().F[a];
      pressure[a] = body.P[a].cwiseProduct(F).sum() / (D * F.determinant());
    });
    sense_shocks(*this, body.neighbours, pressure);
  }

 protected:
  double fourth(std::int64_t a, double kappa) const {
    const double epsilon = epsilon2.empty() ? kappa : std::max(0.0, kappa - epsilon2[a]);
    return epsilon * delta * delta * delta;
  }
};

/// Of the linear momentum and of the volume map.
template <int D>
struct JstWithJ : Jst<D> {
  static constexpr bool of_J = true, nets_J = true;
  static constexpr std::size_t particle_bytes = Jst<D>::particle_bytes + 2 * sizeof(double);

  double kappa4_J = 0;          ///< of the volume map
  std::vector<double> lap_J{};  ///< 1/m^2
  std::vector<double> rate_J{}; ///< D^J, 1/s

  struct Laps {
    Vec<D> p;
    double J;
  };

  void allocate(std::size_t n) {
    Jst<D>::allocate(n);
    lap_J.assign(n, 0.0);
    rate_J.assign(n, 0.0);
  }
  double fourth_J(std::int64_t a) const { return Jst<D>::fourth(a, kappa4_J); }

  template <class Body>
  Laps begin_first(const Body& body, std::int64_t a) const {
    return {Jst<D>::begin_first(body, a), -this->laplacian.sum[a] * body.U.J[a]};
  }
  template <class Body>
  void add_first(Laps& lap, const Body& body, std::int64_t e, std::int32_t b) const {
    Jst<D>::add_first(lap.p, body, e, b);
    lap.J += this->laplacian.l[e] * body.U.J[b];
  }
  void end_first(const Laps& lap, std::int64_t a) {
    Jst<D>::end_first(lap.p, a);
    lap_J[a] = lap.J;
  }

  template <class Body>
  Laps begin_second(const Body& body, std::int64_t a) const {
    return {Jst<D>::begin_second(body, a), -this->laplacian.sum[a] * lap_J[a]};
  }
  template <class Body>
  void add_second(Laps& lap_lap, const Body& body, std::int64_t a, std::int64_t e, std::int32_t b) const {
    Jst<D>::add_second(lap_lap.p, body, a, e, b);
    lap_lap.J += this->laplacian.l[e] * lap_J[b];
  }
  template <class Body>
  void end_second(const Laps& lap_lap, Body& body, std::int64_t a) {
    Jst<D>::end_second(lap_lap.p, body, a);
    rate_J[a] = body.wave[a] * (this->second(a) * lap_J[a] - fourth_J(a) * lap_lap.J);
    body.R.J[a] += rate_J[a];
  }
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
