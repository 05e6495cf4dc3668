/// A coefficient that falls while a body flows.
#pragma once

#include <algorithm>

namespace tessera::solver {

/// Falling linearly from `elastic` to `plastic` while the equivalent plastic strain grows from 0 to `strain`,
/// (5.6); constant where both are equal.
struct PlasticRamp {
  double elastic = 1.0 / 8;
  double plastic = 1.0 / 8;
  double strain = 1;

  static PlasticRamp constant(double value) { return {value, value, 1}; }
  bool ramped() const { return plastic != elastic; }
  bool any() const { return elastic > 0 || plastic > 0; }
  double at(double plastic_strain) const {
    return elastic + (plastic - elastic) * std::min(plastic_strain / strain, 1.0);
  }
};

/// The fourth-order coefficient of (3.85).
using Kappa4 = PlasticRamp;

} // namespace tessera::solver
