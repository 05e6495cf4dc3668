/// What people look at, derived from F and P.
#pragma once

#include "core/tensor.hpp"

#include <cmath>

namespace tessera::solver {

/// Cauchy stress P F^T / J, Pa.
inline Mat3 cauchy(const Mat3& P, const Mat3& F, double J) {
  return P * F.transpose() / J;
}

/// tr(sigma) / 3, Pa: positive in tension.
inline double pressure(const Mat3& sigma) {
  return sigma.trace() / 3;
}

/// sqrt(3/2) |dev sigma|, Pa.
inline double von_mises(const Mat3& sigma) {
  return std::sqrt(1.5) * (sigma - pressure(sigma) * Mat3::Identity()).norm();
}

} // namespace tessera::solver
