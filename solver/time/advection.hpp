/// Chapter 4's model: a wave carried along an endless line of particles, by the operators and Heun's step.
#pragma once

#include "solver/time/stability_region.hpp"

#include <array>
#include <vector>

namespace tessera::solver {

/// du/dt + c du/dx = -c kappa4/dx lap(lap u) on particles dx apart, with the quintic kernel's corrected
/// gradient and Laplacian, (4.12), of 2 or 3 particles per side (the outermost on the rim of the support,
/// of no weight), and central differences for the second Laplacian, (4.40).
struct AdvectionScheme {
  int per_side = 2;  ///< particles per side: 2 or 3
  double kappa4 = 0; ///< of the dissipation
};

/// Derivatives of the kernel of the particle b at the particle a, undivided by powers of dx.
struct KernelRow {
  int offset;                       ///< b - a
  std::array<double, 5> derivative; ///< W, W', ... as it is, (3.52) with alpha = 1/8: tables 4.1, 4.3
  std::array<double, 3> corrected;  ///< W, W', W'' as corrected: tables 4.2, 4.4
};

/// From b = a - per_side to a + per_side. Derivatives are those by x_a, so that odd ones change sign from one
/// side to the other; the third, which jumps at b = a, as it is to the right of it.
std::vector<KernelRow> kernel_table(int per_side);

/// lambda dx/c of the wave exp(I Phi x/dx): the closed forms (4.35), (4.51), (4.75).
Complex advection_eigenvalue(const AdvectionScheme& scheme, double Phi);

/// Factor of a step of courant = c dt/dx.
Complex advection_amplification(const AdvectionScheme& scheme, double courant, double Phi);

/// Its phase over that of the exact wave, arg z / (-courant Phi): below 1 the wave lags.
double dispersion_error(const AdvectionScheme& scheme, double courant, double Phi);

/// Largest courant at which no wave grows: zero where all steps let some grow.
double largest_courant(const AdvectionScheme& scheme);

/// The wave that grows first beyond largest_courant(): Phi, zero for the longest ones.
double first_to_grow(const AdvectionScheme& scheme);

} // namespace tessera::solver
