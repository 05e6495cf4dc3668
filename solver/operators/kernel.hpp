/// Smoothing kernels W(r, s) of support radius s: positive for r < s, falling from the centre on, of unit
/// integral.
#pragma once

#include "solver/operators/gaussian.hpp"
#include "solver/operators/spline.hpp"
#include "solver/operators/wendland.hpp"

#include <string>
#include <vector>

namespace tessera::solver {

enum class KernelShape { wendland, cubic, quartic, quintic, gaussian };

/// Names of the shapes in the order of KernelShape, the default first.
const std::vector<std::string>& kernel_names();

/// Throws InputError naming the choices where there is no such kernel.
KernelShape kernel_named(const std::string& name);

/// A kernel in D = 1, 2 or 3 dimensions, chosen at run time: for building operators, not for a step's loops.
/// The support radius s is where it ends, whatever its shape (s = 2 h in (3.50)-(3.52), 3 h for the
/// Gaussian).
template <int D>
struct Kernel {
  KernelShape shape = KernelShape::wendland;

  /// W, 1/m^D.
  double value(double r, double s) const {
    return of_shape([&](auto kernel) { return kernel.value(r, s); });
  }
  /// W'(r) / r, 1/m^(D+2): finite at r = 0, never positive; grad W = W'(r)/r (X_a - X_b).
  double slope_over_r(double r, double s) const {
    return of_shape([&](auto kernel) { return kernel.slope_over_r(r, s); });
  }
  /// Laplacian of W, W'' + (D - 1) W' / r, 1/m^(D+2).
  double laplacian(double r, double s) const {
    return of_shape([&](auto kernel) { return kernel.laplacian(r, s); });
  }

 private:
  template <class Use>
  double of_shape(Use&& use) const {
    switch (shape) {
    case KernelShape::cubic:
      return use(Spline<D, CubicPowers>{});
    case KernelShape::quartic:
      return use(Spline<D, QuarticPowers>{});
    case KernelShape::quintic:
      return use(Spline<D, QuinticPowers>{});
    case KernelShape::gaussian:
      return use(Gaussian<D>{});
    case KernelShape::wendland:
      break;
    }
    return use(Wendland<D>{});
  }
};

} // namespace tessera::solver
