/// The largest step the scheme is run with.
#pragma once

namespace tessera::solver {

/// dt = sigma Delta / c_max, (3.93): Delta the smallest particle distance (m), c_max the fastest pressure
/// wave as the body is deformed (m/s); s.
template <class Body>
double stable_step(const Body& body, double cfl, double smallest_distance) {
  return cfl * smallest_distance / body.fastest_wave();
}

} // namespace tessera::solver
