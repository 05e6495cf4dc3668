/// Fourth-order JST dissipation made symmetric: it takes energy and conserves momentum on any cloud.
#pragma once

#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/operators/laplacian.hpp"
#include "solver/physics/dissipation.hpp"
#include "solver/physics/plastic_ramp.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace tessera::solver {

/// Of the linear momentum: with L the corrected Laplacian and s = kappa4 c V^(3/D),
///   D = -V^-1 L^T (V s) L p,
/// so that sum V p . D = -sum V s |L p|^2: negative semidefinite whatever the strengths s. L vanishes on
/// linear fields: those are spared, and sum V D = 0.
template <int D>
struct JstSymmetric : DissipationDefaults {
  static constexpr bool active = true, sweeps_first = true;
  static constexpr std::size_t edge_bytes = 2 * sizeof(double),
                               particle_bytes = 3 * sizeof(double) + sizeof(Vec<D>);

  Laplacian laplacian{};
  std::vector<double> transpose{}; ///< V_b l_ba / V_a, 1/m^2, one an edge
  std::vector<double> cube{};      ///< V^(3/D), m^3
  Kappa4 kappa4{};
  std::vector<double> strength{}; ///< s of every particle, m^4/s
  std::vector<Vec<D>> rough_p{};  ///< s L p

  /// Weights of a cloud.
  void weigh(std::span<const Vec3> X, std::span<const double> V, const Neighbours& neighbours,
             const Kernel<D>& kernel = {}) {
    laplacian = build_laplacian<D>(X, V, neighbours, kernel);
    transpose = transposed(laplacian, V, neighbours);
    cube.resize(V.size());
    for_each(neighbours.size(), [&](std::int64_t a) { cube[a] = D == 3 ? V[a] : V[a] * std::sqrt(V[a]); });
  }

  void allocate(std::size_t n) {
    strength.assign(n, 0.0);
    rough_p.assign(n, Vec<D>::Zero());
  }

  template <class Body>
  Vec<D> begin_first(const Body& body, std::int64_t a) const {
    return -laplacian.sum[a] * body.U.p[a];
  }
  template <class Body>
  void add_first(Vec<D>& lap, const Body& body, std::int64_t e, std::int32_t b) const {
    lap += laplacian.l[e] * body.U.p[b];
  }
  void end_first(const Vec<D>& lap, std::int64_t a) { rough_p[a] = strength[a] * lap; }

  template <class Body>
  Vec<D> begin_second(const Body&, std::int64_t a) const {
    return -laplacian.sum[a] * rough_p[a];
  }
  template <class Body>
  void add_second(Vec<D>& sum, const Body&, std::int64_t, std::int64_t e, std::int32_t b) const {
    sum += transpose[e] * rough_p[b];
  }
  template <class Body>
  void end_second(const Vec<D>& sum, Body& body, std::int64_t a) {
    body.R.p[a] -= sum;
  }

  template <class Body>
  void advance(const Body& body) {
    for_each(body.size(), [&](std::int64_t a) {
      const double kappa_a =
          kappa4.ramped() ? kappa4.at(body.material->equivalent_plastic_strain(a)) : kappa4.elastic;
      strength[a] = kappa_a * body.wave[a] * cube[a];
    });
  }
};

/// Of the linear momentum and, in the same form, of the volume map, whose total sum V J it keeps.
template <int D>
struct JstSymmetricWithJ : JstSymmetric<D> {
  using Base = JstSymmetric<D>;
  static constexpr bool of_J = true;
  static constexpr std::size_t particle_bytes = Base::particle_bytes + 2 * sizeof(double);

  double kappa4_J = 0;              ///< of the volume map
  std::vector<double> strength_J{}; ///< kappa4_J c V^(3/D), m^4/s
  std::vector<double> rough_J{};    ///< strength times L J

  void allocate(std::size_t n) {
    Base::allocate(n);
    strength_J.assign(n, 0.0);
    rough_J.assign(n, 0.0);
  }

  struct Sum {
    Vec<D> p;
    double J;
  };

  template <class Body>
  Sum begin_first(const Body& body, std::int64_t a) const {
    return {Base::begin_first(body, a), -this->laplacian.sum[a] * body.U.J[a]};
  }
  template <class Body>
  void add_first(Sum& lap, const Body& body, std::int64_t e, std::int32_t b) const {
    Base::add_first(lap.p, body, e, b);
    lap.J += this->laplacian.l[e] * body.U.J[b];
  }
  void end_first(const Sum& lap, std::int64_t a) {
    Base::end_first(lap.p, a);
    rough_J[a] = strength_J[a] * lap.J;
  }

  template <class Body>
  Sum begin_second(const Body& body, std::int64_t a) const {
    return {Base::begin_second(body, a), -this->laplacian.sum[a] * rough_J[a]};
  }
  template <class Body>
  void add_second(Sum& sum, const Body& body, std::int64_t a, std::int64_t e, std::int32_t b) const {
    Base::add_second(sum.p, body, a, e, b);
    sum.J += this->transpose[e] * rough_J[b];
  }
  template <class Body>
  void end_second(const Sum& sum, Body& body, std::int64_t a) {
    Base::end_second(sum.p, body, a);
    body.R.J[a] -= sum.J;
  }

  template <class Body>
  void advance(const Body& body) {
    Base::advance(body);
    for_each(body.size(), [&](std::int64_t a) { strength_J[a] = kappa4_J * body.wave[a] * this->cube[a]; });
  }
};

} // namespace tessera::solver
