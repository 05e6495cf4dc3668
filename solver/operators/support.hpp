/// Kernel radii: one for all on lattices, each particle's own on irregular clouds.
#pragma once

#include "core/neighbours.hpp"
#include "core/tensor.hpp"
#include "solver/operators/kernel.hpp"

#include <span>
#include <vector>

namespace tessera::solver {

/// The same radius for every particle.
Neighbours uniform_support(std::span<const Vec3> X, double radius, const HiddenPairs& hidden = {});

/// Each particle's smallest radius that holds `neighbours` others it sees and whose moment matrix is
/// conditioned better than 1e3 (the radius grows by tenths until it is). InputError when the cloud has not
/// that many particles.
template <int D>
Neighbours adaptive_support(std::span<const Vec3> X, std::span<const double> V, int neighbours,
                            const HiddenPairs& hidden = {}, const Kernel<D>& kernel = {});

} // namespace tessera::solver
