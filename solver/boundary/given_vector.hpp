/// A vector prescribed in space and time.
#pragma once

#include "core/tensor.hpp"

#include <functional>

namespace tessera::solver {

/// Of the reference position X (m) and the time (s). Not called from several threads at once.
struct GivenVector {
  std::function<Vec3(const Vec3& X, double time)> value;
  bool uniform = false; ///< the same at every X: asked for once, not once a particle
};

} // namespace tessera::solver
