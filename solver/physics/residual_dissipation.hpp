/// Dissipation of what a linear field cannot carry: it takes energy and conserves momentum on any cloud, and
/// is of fourth order where the momenta are smooth.
#pragma once

#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/operators/gradient.hpp"
#include "solver/physics/dissipation.hpp"
#include "solver/physics/plastic_ramp.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace tessera::solver {

/// Of the linear momentum: minus the slope, over V_a, of what the best linear fits m_a around the particles
/// leave of it,
///   E = 1/4 sum_a s_a sum_b omega_ab |p_b - p_a - m_a (X_b - X_a)|^2,   s = kappa c V^(1/D),
///   D_a = 1/V_a sum_b omega_ab [(s_a + s_b)/2 (p_b - p_a) - (s_a m_a + s_b m_b)/2 (X_b - X_a)]
/// with omega_ab = V_a V_b |W'|/r. As each m_a makes its own share of E smallest, its change does not enter
/// the slope. So sum V p . D = -2 E: negative semidefinite whatever the strengths s. Zero on linear fields,
/// antisymmetric in pairs.
template <int D>
struct ResidualDissipation : DissipationDefaults {
  static constexpr bool active = true, sweeps_first = true;
  static constexpr std::size_t edge_bytes = sizeof(double),
                               particle_bytes = 2 * sizeof(Vec<D>) + 2 * sizeof(Mat<D>) + 2 * sizeof(double);

  std::vector<double> weight{};         ///< omega_ab / V_a, 1/m^2, one an edge
  std::vector<Vec<D>> X{};              ///< reference positions, m
  std::vector<Vec<D>> lean{};           ///< sum_b weight (X_b - X_a), 1/m
  std::vector<Mat<D>> inverse_moment{}; ///< [sum_b weight (X_b - X_a) (x) (X_b - X_a)]^-1
  std::vector<double> length{};         ///< V^(1/D), m
  PlasticRamp kappa = PlasticRamp::constant(1);
  std::vector<double> strength{}; ///< s of every particle, m^2/s
  std::vector<Mat<D>> slope{};    ///< m of the momenta in the last first sweep

  /// Weights of a cloud. Every particle's neighbours must span the space.
  void weigh(std::span<const Vec3> positions, std::span<const double> V, const Neighbours& neighbours,
             const Kernel<D>& kernel = {}) {
    const std::size_t n = V.size();
    weight.resize(static_cast<std::size_t>(neighbours.edges()));
    X.resize(n);
    lean.assign(n, Vec<D>::Zero());
    inverse_moment.resize(n);
    length.resize(n);
    for_each(neighbours.size(), [&](std::int64_t a) {
      X[a] = positions[a].template head<D>();
      length[a] = D == 3 ? std::cbrt(V[a]) : std::sqrt(V[a]);
      inverse_moment[a] = moment_matrix<D>(a, positions, V, neighbours, kernel).inverse();
      for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
        const std::int32_t b = neighbours.column[e];
        const Vec<D> R = (positions[b] - positions[a]).template head<D>();
        weight[e] = -V[b] * kernel.slope_over_r(R.norm(), neighbours.pair_support(a, b));
        lean[a] += weight[e] * R;
      }
    });
  }

  void allocate(std::size_t n) {
    strength.assign(n, 0.0);
    slope.assign(n, Mat<D>::Zero());
  }

  /// Of p_b (x) (X_b - X_a) over the neighbours b of the particle at X.
  struct First {
    Vec<D> X;
    Mat<D> p;
  };

  template <class Body>
  First begin_first(const Body& body, std::int64_t a) const {
    return {X[a], -body.U.p[a] * lean[a].transpose()};
  }
  template <class Body>
  void add_first(First& sum, const Body& body, std::int64_t e, std::int32_t b) const {
    const Vec<D> R = weight[e] * (X[b] - sum.X);
    for (int c = 0; c < D; ++c)
      sum.p.col(c) += R[c] * body.U.p[b];
  }
  void end_first(const First& sum, std::int64_t a) { slope[a] = sum.p * inverse_moment[a]; }

  template <class Body>
  Vec<D> begin_second(const Body&, std::int64_t a) const {
    return -strength[a] * (slope[a] * lean[a]);
  }
  template <class Body>
  void add_second(Vec<D>& sum, const Body& body, std::int64_t a, std::int64_t e, std::int32_t b) const {
    sum += weight[e] * ((strength[a] + strength[b]) * (body.U.p[b] - body.U.p[a]) -
                        strength[b] * (slope[b] * (X[b] - X[a])));
  }
  template <class Body>
  void end_second(const Vec<D>& sum, Body& body, std::int64_t a) {
    body.R.p[a] += 0.5 * sum;
  }

  template <class Body>
  void advance(const Body& body) {
    for_each(body.size(), [&](std::int64_t a) {
      const double kappa_a =
          kappa.ramped() ? kappa.at(body.material->equivalent_plastic_strain(a)) : kappa.elastic;
      strength[a] = kappa_a * body.wave[a] * length[a];
    });
  }
};

/// Of the linear momentum and, in the same form, of the volume map, whose total sum V J it keeps.
template <int D>
struct ResidualDissipationWithJ : ResidualDissipation<D> {
  using Base = ResidualDissipation<D>;
  static constexpr bool of_J = true;
  static constexpr std::size_t particle_bytes = Base::particle_bytes + sizeof(Vec<D>) + 2 * sizeof(double);

  double kappa_J = 0;               ///< of the volume map
  std::vector<double> strength_J{}; ///< kappa_J c V^(1/D), m^2/s
  /// J and the slope of the best linear fit to it, 1/m, in the last first sweep: between the sweeps a step
  /// may advance the body's own.
  struct Seen {
    Vec<D> slope;
    double J;
  };
  std::vector<Seen> seen{};

  void allocate(std::size_t n) {
    Base::allocate(n);
    strength_J.assign(n, 0.0);
    seen.assign(n, {Vec<D>::Zero(), 1});
  }

  struct First {
    typename Base::First of_p;
    Vec<D> of_J;
    double J;
  };
  struct Second {
    Vec<D> p;
    double J;
  };

  template <class Body>
  First begin_first(const Body& body, std::int64_t a) const {
    return {Base::begin_first(body, a), -body.U.J[a] * this->lean[a], body.U.J[a]};
  }
  template <class Body>
  void add_first(First& sum, const Body& body, std::int64_t e, std::int32_t b) const {
    Base::add_first(sum.of_p, body, e, b);
    sum.of_J += (this->weight[e] * body.U.J[b]) * (this->X[b] - sum.of_p.X);
  }
  void end_first(const First& sum, std::int64_t a) {
    Base::end_first(sum.of_p, a);
    seen[a] = {this->inverse_moment[a] * sum.of_J, sum.J};
  }

  template <class Body>
  Second begin_second(const Body& body, std::int64_t a) const {
    return {Base::begin_second(body, a), -strength_J[a] * seen[a].slope.dot(this->lean[a])};
  }
  template <class Body>
  void add_second(Second& sum, const Body& body, std::int64_t a, std::int64_t e, std::int32_t b) const {
    Base::add_second(sum.p, body, a, e, b);
    sum.J += this->weight[e] * ((strength_J[a] + strength_J[b]) * (seen[b].J - seen[a].J) -
                                strength_J[b] * seen[b].slope.dot(this->X[b] - this->X[a]));
  }
  template <class Body>
  void end_second(const Second& sum, Body& body, std::int64_t a) {
    Base::end_second(sum.p, body, a);
    body.R.J[a] += 0.5 * sum.J;
  }

  template <class Body>
  void advance(const Body& body) {
    Base::advance(body);
    for_each(body.size(), [&](std::int64_t a) { strength_J[a] = kappa_J * body.wave[a] * this->length[a]; });
  }
};

} // namespace tessera::solver
