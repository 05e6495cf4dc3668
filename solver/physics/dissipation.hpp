/// What a body asks of its dissipation.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tessera::solver {

/// A dissipation is a type with these members, which do nothing unless it has its own. Both sweeps over the
/// edges of a step begin a sum at particle a, add the neighbours b of its edges e, and end it: the first by
/// keeping it, the second by adding the dissipation to the rates of the body.
struct DissipationDefaults {
  static constexpr bool active = false;       ///< the step is then bounded by the spectrum too
  static constexpr bool of_J = false;         ///< it acts on the volume map too
  static constexpr bool nets_J = false;       ///< and does not keep sum V J by itself
  static constexpr bool sweeps_first = false; ///< it has something to gather in the first sweep
  static constexpr std::size_t edge_bytes = 0, particle_bytes = 0;
  static constexpr std::size_t sensor_bytes = 0; ///< a particle, beside those, where there is a shock term

  struct Sum {};

  void allocate(std::size_t) {}
  template <class Body>
  Sum begin_first(const Body&, std::int64_t) const {
    return {};
  }
  template <class Body>
  void add_first(Sum&, const Body&, std::int64_t, std::int32_t) const {}
  void end_first(const Sum&, std::int64_t) {}

  template <class Body>
  Sum begin_second(const Body&, std::int64_t) const {
    return {};
  }
  template <class Body>
  void add_second(Sum&, const Body&, std::int64_t, std::int64_t, std::int32_t) const {}
  template <class Body>
  void end_second(const Sum&, Body&, std::int64_t) {}

  /// P belongs to U again.
  template <class Body>
  void sense(const Body&) {}
  /// The histories and wave speeds of the body have advanced.
  template <class Body>
  void advance(const Body&) {}
};

/// For scenes that ask for none: no weights, no arrays, no loop.
struct NoDissipation : DissipationDefaults {};

} // namespace tessera::solver
