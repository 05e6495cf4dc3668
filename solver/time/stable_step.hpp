/// The largest step the scheme is run with.
#pragma once

namespace tessera::solver {

/// dt = length / c_max, (3.93): length the way a wave may go in a step (m), sigma times the smallest particle
/// distance; c_max the fastest pressure wave as the body is deformed (m/s); s.
template <class Body>
double stable_step(const Body& body, double length) {
  return length / body.fastest_wave();
}

} // namespace tessera::solver
