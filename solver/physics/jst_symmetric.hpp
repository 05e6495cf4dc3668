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
/// linear fields: those are spared, and sum V D = 0. With J, in the same form, of the volume map, whose total
/// sum V J it keeps.
template <int D, bool with_J = false>
struct JstSymmetric : DissipationDefaults<D, with_J> {
  using Base = DissipationDefaults<D, with_J>;
  using typename Base::Field, typename Base::Moments, typename Base::Reach;
  static constexpr bool active = true, gathers = true;
  static constexpr std::size_t edge_bytes = 2 * sizeof(double),
                               particle_bytes = 2 * sizeof(double) + 2 * sizeof(Field);

  Laplacian laplacian{};
  std::vector<double> transpose{}; ///< V_b l_ba / V_a, 1/m^2, one an edge
  std::vector<double> cube{};      ///< V^(3/D), m^3
  Kappa4 kappa4{};
  double kappa4_J = 0;           ///< of the volume map
  std::vector<Field> strength{}; ///< s of every particle, m^4/s
  std::vector<Field> rough{};    ///< s L p

  /// Weights of a cloud.
  void weigh(std::span<const Vec3> X, std::span<const double> V, const Neighbours& neighbours,
             const Kernel<D>& kernel = {}) {
    laplacian = build_laplacian<D>(X, V, neighbours, kernel);
    transpose = transposed(laplacian, V, neighbours);
    cube.resize(V.size());
    for_each(neighbours.size(), [&](std::int64_t a) { cube[a] = D == 3 ? V[a] : V[a] * std::sqrt(V[a]); });
  }

  void allocate(std::size_t n) {
    strength.assign(n, Field::Zero());
    rough.assign(n, Field::Zero());
  }

  using First = SumOf<Field>;
  void add_first(First& sum, std::int64_t e, const Field& change) const {
    sum.value += laplacian.l[e] * change;
  }
  template <class Body>
  void end_first(const First& sum, const Moments&, const Body&, std::int64_t a) {
    rough[a] = strength[a].cwiseProduct(sum.value);
  }

  using Second = SumOf<Field>;
  void add_second(Second& sum, std::int64_t, std::int64_t e, std::int32_t b, const Field&, double,
                  const Reach&) const {
    sum.value += transpose[e] * rough[b];
  }
  template <class Body>
  Field end_second(const Second& sum, const Reach&, const Body&, std::int64_t a) const {
    return laplacian.sum[a] * rough[a] - sum.value;
  }

  template <class Body>
  void advance(const Body& body) {
    for_each(body.size(), [&](std::int64_t a) {
      const double kappa_a =
          kappa4.ramped() ? kappa4.at(body.material->equivalent_plastic_strain(a)) : kappa4.elastic;
      const double c_cube = body.wave[a] * cube[a];
      strength[a] = Base::spread(kappa_a * c_cube, kappa4_J * c_cube);
    });
  }
};

} // namespace tessera::solver
