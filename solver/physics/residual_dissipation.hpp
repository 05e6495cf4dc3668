/// Dissipation of what a linear field cannot carry: it takes energy and conserves momentum on any cloud, and
/// is of fourth order where the momenta are smooth.
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/physics/dissipation.hpp"
#include "solver/physics/plastic_ramp.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace tessera::solver {

/// Of the linear momentum: minus the slope, over V_a, of what the best linear fits m_a around the particles
/// leave of it,
///   E = 1/4 sum_a s_a sum_b omega_ab |p_b - p_a - m_a (X_b - X_a)|^2,   s = kappa c V^(1/D),
///   D_a = 1/(2 V_a) sum_b omega_ab [(s_a + s_b) (p_b - p_a) - (s_a m_a + s_b m_b) (X_b - X_a)]
/// with the gradient's omega_ab. As each m_a makes its own share of E smallest, its change does not enter the
/// slope. So sum V p . D = -2 E: negative semidefinite whatever the strengths s. Zero on linear fields,
/// antisymmetric in pairs. With J, in the same form, of the volume map, whose total sum V J it keeps.
template <int D, bool with_J = false>
struct ResidualDissipation : DissipationDefaults<D, with_J> {
  using Base = DissipationDefaults<D, with_J>;
  using typename Base::Field, typename Base::First, typename Base::Moments, typename Base::Reach;
  static constexpr bool active = true, fits = true;
  static constexpr std::size_t particle_bytes = sizeof(double) + sizeof(Field) + sizeof(Moments);

  PlasticRamp kappa = PlasticRamp::constant(1);
  double kappa_J = 0;            ///< of the volume map
  std::vector<double> length{};  ///< V^(1/D), m
  std::vector<Field> strength{}; ///< s of every particle, m^2/s
  std::vector<Moments> slope{};  ///< m of the field in the last first sweep

  /// Lengths of particles of the volumes V, m^D.
  void weigh(std::span<const double> V) {
    length.resize(V.size());
    for_each(static_cast<std::int64_t>(V.size()),
             [&](std::int64_t a) { length[a] = D == 3 ? std::cbrt(V[a]) : std::sqrt(V[a]); });
  }

  void allocate(std::size_t n) {
    strength.assign(n, Field::Zero());
    slope.assign(n, Moments::Zero());
  }

  template <class Body>
  void end_first(const First&, const Moments& moments, const Body& body, std::int64_t a) {
    slope[a].noalias() = moments * body.gradient.inverse_moment[a];
  }

  struct Second {
    Field change = Field::Zero(); ///< sum omega_ab (p_b - p_a)
    Field forces = Field::Zero(); ///< sum omega_ab s_b (p_b - p_a - m_b (X_b - X_a))
  };
  void add_second(Second& sum, std::int64_t, std::int64_t, std::int32_t b, const Field& change, double omega,
                  const Reach& reach) const {
    const Field weighted = omega * change;
    sum.change += weighted;
    sum.forces += strength[b].cwiseProduct(weighted - along(slope[b], reach));
  }
  template <class Body>
  Field end_second(const Second& sum, const Reach& reach, const Body& body, std::int64_t a) const {
    const Field own = strength[a].cwiseProduct(sum.change - along(slope[a], reach));
    return (0.5 / body.V[a]) * (sum.forces + own);
  }

  template <class Body>
  void advance(const Body& body) {
    for_each(body.size(), [&](std::int64_t a) {
      const double kappa_a =
          kappa.ramped() ? kappa.at(body.material->equivalent_plastic_strain(a)) : kappa.elastic;
      const double c_length = body.wave[a] * length[a];
      strength[a] = Base::spread(kappa_a * c_length, kappa_J * c_length);
    });
  }

 private:
  static Field along(const Moments& slope, const Reach& reach) {
    Field sum = slope.col(0) * reach(0, 0);
    for (int j = 1; j < D; ++j)
      sum += slope.col(j) * reach(j, 0);
    return sum;
  }
};

} // namespace tessera::solver
