/// All eigenvalues of a small body's linearised operators, and the largest step they bear.
#pragma once

#include "solver/time/linearised.hpp"
#include "solver/time/stability_region.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tessera::solver {

/// In a stable step no disturbance grows by more than this fraction, 1 % in a thousand steps, beyond what the
/// operators themselves let the fastest one grow and a tenth of that. Zero eigenvalues (rigid motions, fields
/// that the operators do not see) come out of the matrices as tiny numbers of either sign.
constexpr double tolerated_growth = 1e-5;

/// Rows of the largest matrix whose eigenvalues are found once (two minutes), and of that found for one trial
/// step after another.
constexpr std::int64_t largest_matrix = 3000, largest_step_matrix = 1600;

struct Spectrum {
  std::vector<Complex> eigenvalues; ///< of d/dt of (u, v) or (u, v, J), 1/s
  double growth_rate = 0;           ///< largest real part, 1/s: growth whatever the step
  bool grows = false;               ///< whether that is more than the round-off of zero eigenvalues
  /// Up to which the method adds no growth, s; zero where every step adds some. Absent where Verlet's step
  /// would have to be taken apart and is too large for it.
  std::optional<double> largest_step;
};

/// For "heun" or "verlet", its dissipation half a step behind.
Spectrum spectrum_of(const Linearised& body, const std::string& integrator);

/// Largest amplification of a disturbance by one of Verlet's steps of dt, s.
double verlet_amplification(const Linearised& body, double dt);

} // namespace tessera::solver
