/// What a body asks of its dissipation.
#pragma once

#include "core/lanes.hpp"

#include <cstddef>
#include <cstdint>

namespace tessera::solver {

/// A sum over edges that begins at zero.
template <class Field>
struct SumOf {
  Field value = Field::Zero();
};

/// A dissipation is a type with these members, which do nothing unless it has its own. It acts on the D
/// components of the linear momentum and, as one more, on the volume map: `Field`. Both sweeps over the edges
/// of a step begin a sum at particle a, add the neighbours b of its edges e, and end it: the first by keeping
/// it, the second by giving the rates.
template <int D, bool with_J = false>
struct DissipationDefaults {
  static constexpr bool active = false;  ///< the step is then bounded by the spectrum too
  static constexpr bool of_J = with_J;   ///< it acts on the volume map too
  static constexpr bool nets_J = false;  ///< and does not keep sum V J by itself
  static constexpr bool fits = false;    ///< it wants the moments of the field's changes in the first sweep
  static constexpr bool gathers = false; ///< it gathers something of its own in the first sweep
  static constexpr std::size_t edge_bytes = 0, particle_bytes = 0;
  static constexpr std::size_t sensor_bytes = 0; ///< a particle, beside those, where there is a shock term

  using Field = Lanes<D + with_J>;      ///< p (kg/(m^2 s)), J (-)
  using Moments = Lanes<D + with_J, D>; ///< sum_b change (x) omega_ab (X_b - X_a)
  using Reach = Lanes<D, 2>;            ///< omega_ab (X_b - X_a | lambda_b - lambda_a)

  void allocate(std::size_t) {}

  struct First {};
  /// `change` of the field from a to b.
  void add_first(First&, std::int64_t, const Field&) const {}
  template <class Body>
  void end_first(const First&, const Moments&, const Body&, std::int64_t) {}

  struct Second {};
  void add_second(Second&, std::int64_t, std::int64_t, std::int32_t, const Field&, double,
                  const Reach&) const {}

  /// P belongs to U again.
  template <class Body>
  void sense(const Body&) {}
  /// The histories and wave speeds of the body have advanced.
  template <class Body>
  void advance(const Body&) {}

 protected:
  /// `of_p` for the momenta, `of_J` for the volume map.
  static Field spread(double of_p, double of_J) {
    Field field = Field::Constant(of_p);
    if constexpr (with_J)
      field[D] = of_J;
    return field;
  }
};

/// For scenes that ask for none: no weights, no arrays, no loop.
template <int D>
struct NoDissipation : DissipationDefaults<D> {};

} // namespace tessera::solver
