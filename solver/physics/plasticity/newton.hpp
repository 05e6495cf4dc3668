/// Root of a decreasing function by Newton's method that cannot fail to end.
#pragma once

#include <cmath>

namespace tessera::solver {

/// A function's value and slope at a point.
struct Tangent {
  double value, slope;
};

/// The d in [low, high] where the decreasing f(d) -> Tangent falls through zero, to |f| <= tolerance.
/// Newton's steps from `low`, quadratic once near; a step that leaves the bracket, and every step after the
/// first twenty, halves the bracket instead. Where rounding keeps |f| above the tolerance: the d at which no
/// number is left between the bracket's ends.
template <class F>
double decreasing_root(F&& f, double low, double high, double tolerance) {
  constexpr int newton_steps = 20;
  double d = low;
  for (int i = 0;; ++i) {
    const auto [value, slope] = f(d);
    if (std::abs(value) <= tolerance)
      return d;
    (value > 0 ? low : high) = d;
    const double newton = d - value / slope, middle = low + 0.5 * (high - low);
    if (!(low < middle && middle < high)) // also where something is not a number
      return d;
    d = i < newton_steps && low < newton && newton < high ? newton : middle;
  }
}

} // namespace tessera::solver
