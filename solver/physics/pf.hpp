/// The {p, F} formulation: what it evolves, and nothing else.
#pragma once

#include "core/tensor.hpp"

#include <tuple>
#include <vector>

namespace tessera::solver {

/// Linear momentum, deformation gradient and position of every particle; also the type of their rates.
template <int D>
struct PF {
  static constexpr int dimension = D;
  static constexpr const char* name = "pF";

  std::vector<Vec<D>> p; ///< linear momentum per reference volume, kg/(m^2 s)
  std::vector<Mat<D>> F; ///< deformation gradient since the start, -
  std::vector<Vec<D>> x; ///< current position, m

  auto fields() { return std::tie(p, F, x); }
  auto fields() const { return std::tie(p, F, x); }

  explicit PF(std::size_t n = 0) : p(n, Vec<D>::Zero()), F(n, Mat<D>::Identity()), x(n, Vec<D>::Zero()) {}
};

} // namespace tessera::solver
