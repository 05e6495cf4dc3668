/// Vectors as long as what the processor takes at once: a fourth component rides along with three.
#pragma once

#include <Eigen/Core>

namespace tessera {

/// Components a vector of n has in memory where loops over edges read it: 2 or 4, so that it is loaded by one
/// aligned instruction. Those beyond n are zero, or carry what shares the way.
template <int n>
inline constexpr int lanes = n <= 2 ? 2 : 4;

/// `columns` such vectors side by side.
template <int n, int columns = 1>
using Lanes = Eigen::Matrix<double, lanes<n>, columns>;

} // namespace tessera
