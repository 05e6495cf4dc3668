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

/// Of the linear momentum and, with J, of the volume map. c is the local pressure wave speed, Delta the
/// smallest particle distance.
template <int D, bool with_J = false>
struct Jst : DissipationDefaults<D, with_J> {
  using Base = DissipationDefaults<D, with_J>;
  using typename Base::Field, typename Base::Moments, typename Base::Reach;
  static constexpr bool active = true, gathers = true, nets_J = with_J;
  static constexpr std::size_t edge_bytes = sizeof(double),
                               particle_bytes = 2 * sizeof(double) + sizeof(Field),
                               sensor_bytes = sizeof(double);

  Laplacian laplacian{};
  double delta = 1; ///< Delta, m
  Kappa4 kappa4{};
  double kappa4_J = 0;            ///< of the volume map
  double kappa2 = 0;              ///< of the shock term; 0: no sensor, no array
  double pressure_floor = 0;      ///< Pa: pressures below it are no shock's
  std::vector<double> epsilon4{}; ///< kappa4 of every particle; the shock term takes its part off
  std::vector<double> epsilon2{}; ///< kappa2 times the largest sensor among the neighbours; empty without
  std::vector<Field> lap{};       ///< lap p, kg/(m^4 s), and lap J, 1/m^2

  void allocate(std::size_t n) {
    epsilon4.assign(n, kappa4.elastic);
    if (kappa2 > 0)
      epsilon2.assign(n, 0.0);
    lap.assign(n, Field::Zero());
  }

  /// The undivided coefficients of c lap U and of -c lap(lap U) at particle a: m and m^3.
  double second(std::int64_t a) const { return epsilon2.empty() ? 0 : epsilon2[a] * delta; }
  double fourth(std::int64_t a) const { return fourth(a, epsilon4[a]); }
  double fourth_J(std::int64_t a) const { return fourth(a, kappa4_J); }

  using First = SumOf<Field>;
  void add_first(First& sum, std::int64_t e, const Field& change) const {
    sum.value += laplacian.l[e] * change;
  }
  template <class Body>
  void end_first(const First& sum, const Moments&, const Body&, std::int64_t a) {
    lap[a] = sum.value;
  }

  using Second = SumOf<Field>;
  void add_second(Second& sum, std::int64_t a, std::int64_t e, std::int32_t b, const Field&, double,
                  const Reach&) const {
    sum.value += laplacian.l[e] * (lap[b] - lap[a]);
  }
  template <class Body>
  Field end_second(const Second& sum, const Reach&, const Body& body, std::int64_t a) const {
    const Field fourths = Base::spread(fourth(a), fourth_J(a));
    return body.wave[a] * (second(a) * lap[a] - fourths.cwiseProduct(sum.value));
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
      pressure[a] = body.P(a).cwiseProduct(F).sum() / (D * F.determinant());
    });
    sense_shocks(*this, body.neighbours, pressure);
  }

 private:
  double fourth(std::int64_t a, double kappa) const {
    const double epsilon = epsilon2.empty() ? kappa : std::max(0.0, kappa - epsilon2[a]);
    return epsilon * delta * delta * delta;
  }
};

/// epsilon2 of every particle from its pressures (Pa): kappa2 times the largest sensor (3.87) of itself and
/// its neighbours. The sensor |sum_b l_ab (pr_b - pr_a)| / sum_b |l_ab| (|pr_b| + |pr_a| + floor) is a second
/// difference of the pressure: at most 1, of order one at a jump, of second order in the spacing where the
/// pressure is smooth. Absolute values, because a solid's pressure changes its sign where there is no shock.
template <int D, bool with_J>
void sense_shocks(Jst<D, with_J>& jst, const Neighbours& neighbours, std::span<const double> pressure) {
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
