/// Jameson-Schmidt-Turkel dissipation of the linear momentum, (3.83)-(3.89).
#pragma once

#include "core/tensor.hpp"
#include "solver/operators/laplacian.hpp"

#include <vector>

namespace tessera::solver {

/// Fourth-order term D4 = -kappa4 c Delta^3 lap(lap p), with c the local pressure wave speed and Delta the
/// smallest particle distance.
template <int D>
struct Jst {
  static constexpr bool active = true;

  Laplacian laplacian;
  double kappa4_delta3;        ///< kappa4 Delta^3, m^3
  std::vector<Vec<D>> lap_p{}; ///< lap p, kg/(m^4 s)
};

/// For scenes that ask for none: no weights, no arrays, no loop.
struct NoDissipation {
  static constexpr bool active = false;
};

} // namespace tessera::solver
