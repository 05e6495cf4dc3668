/// Dissipation of what a linear field cannot carry: conservative in pairs on any cloud, of fourth order where
/// the momenta are smooth.
#pragma once

#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/physics/dissipation.hpp"
#include "solver/physics/plastic_ramp.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace tessera::solver {

/// Of the linear momentum:
///   D_a = 1/V_a sum_b (kappa c)_ab h_ab omega_ab [(p_b - p_a) - (grad p_a + grad p_b)/2 (X_b - X_a)]
/// with omega_ab = V_a V_b |W'|/r, h_ab and (kappa c)_ab the means of V^(1/D) and of kappa c of the two. Zero
/// on linear fields, antisymmetric in pairs.
template <int D>
struct ResidualDissipation : DissipationDefaults {
  static constexpr bool active = true, looks_at_gradient = true;
  static constexpr std::size_t edge_bytes = sizeof(double), particle_bytes = sizeof(Vec<D>) + sizeof(double);

  std::vector<double> weight{}; ///< h_ab omega_ab / V_a, 1/m, one an edge
  std::vector<Vec<D>> X{};      ///< reference positions, m
  PlasticRamp kappa = PlasticRamp::constant(1);
  std::vector<double> strength{}; ///< kappa c of every particle, m/s

  /// Weights of a cloud.
  void weigh(std::span<const Vec3> positions, std::span<const double> V, const Neighbours& neighbours,
             const Kernel<D>& kernel = {}) {
    weight = pair_weights<D>(positions, V, neighbours, kernel);
    std::vector<double> length(V.size());
    X.resize(V.size());
    for_each(neighbours.size(), [&](std::int64_t a) {
      length[a] = D == 3 ? std::cbrt(V[a]) : std::sqrt(V[a]);
      X[a] = positions[a].template head<D>();
    });
    for_each(neighbours.size(), [&](std::int64_t a) {
      for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e)
        weight[e] *= 0.5 * (length[a] + length[neighbours.column[e]]) / V[a];
    });
  }

  void allocate(std::size_t n) { strength.assign(n, 0.0); }

  struct Sum {
    Vec<D> p = Vec<D>::Zero();    ///< but for grad p_a
    Vec<D> lean = Vec<D>::Zero(); ///< weighted mean of X_b - X_a
  };

  /// (kappa c)_ab h_ab omega_ab / V_a, 1/s.
  double pull(std::int64_t a, std::int64_t e, std::int32_t b) const {
    return 0.5 * (strength[a] + strength[b]) * weight[e];
  }

  template <class Body>
  Sum begin_second(const Body&, std::int64_t) const {
    return {};
  }
  template <class Body>
  void add_second(Sum& sum, const Body& body, std::int64_t a, std::int64_t e, std::int32_t b) const {
    const double q = pull(a, e, b);
    const Vec<D> R = q * (X[b] - X[a]);
    sum.lean += R;
    sum.p += q * (body.U.p[b] - body.U.p[a]) - (0.5 * body.density) * (body.velocity_gradient(b) * R);
  }
  template <class Body>
  void end_second(const Sum& sum, Body& body, std::int64_t a) {
    body.R.p[a] += sum.p - (0.5 * body.density) * (body.velocity_gradient(a) * sum.lean);
  }

  template <class Body>
  void advance(const Body& body) {
    for_each(body.size(), [&](std::int64_t a) {
      const double kappa_a =
          kappa.ramped() ? kappa.at(body.material->equivalent_plastic_strain(a)) : kappa.elastic;
      strength[a] = kappa_a * body.wave[a];
    });
  }
};

/// Of the linear momentum and, in the same form, of the volume map, whose total sum V J it keeps.
template <int D>
struct ResidualDissipationWithJ : ResidualDissipation<D> {
  using Base = ResidualDissipation<D>;
  static constexpr bool of_J = true, sweeps_first = true;
  /// J and its gradient (1/m), of one time: between the sweeps a step may advance the body's own.
  struct Seen {
    Vec<D> grad;
    double J;
  };

  static constexpr std::size_t particle_bytes = Base::particle_bytes + sizeof(Seen);

  double kappa_J = 0;       ///< of the volume map
  std::vector<Seen> seen{}; ///< in the last first sweep

  void allocate(std::size_t n) {
    Base::allocate(n);
    seen.assign(n, {Vec<D>::Zero(), 1});
  }

  struct Sum {
    typename Base::Sum of_p{};
    double J = 0;
  };

  template <class Body>
  Seen begin_first(const Body& body, std::int64_t a) const {
    return {-body.U.J[a] * body.gradient.s[a], body.U.J[a]};
  }
  template <class Body>
  void add_first(Seen& at, const Body& body, std::int64_t e, std::int32_t b) const {
    at.grad += body.U.J[b] * body.gradient.w[e];
  }
  void end_first(const Seen& at, std::int64_t a) { seen[a] = at; }

  template <class Body>
  Sum begin_second(const Body&, std::int64_t) const {
    return {};
  }
  template <class Body>
  void add_second(Sum& sum, const Body& body, std::int64_t a, std::int64_t e, std::int32_t b) const {
    Base::add_second(sum.of_p, body, a, e, b);
    const double q = 0.5 * (body.wave[a] + body.wave[b]) * this->weight[e];
    const Vec<D> R = this->X[b] - this->X[a];
    sum.J += q * (seen[b].J - seen[a].J - 0.5 * (seen[a].grad + seen[b].grad).dot(R));
  }
  template <class Body>
  void end_second(const Sum& sum, Body& body, std::int64_t a) {
    Base::end_second(sum.of_p, body, a);
    body.R.J[a] += kappa_J * sum.J;
  }
};

} // namespace tessera::solver
