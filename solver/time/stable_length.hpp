/// How long a step the semi-discrete system itself bears.
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/physics/material.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace tessera::solver {

/// Largest |eigenvalue| of the linearised system dp/dt = div S + D(p), dS/dt = C : grad p / rho about the
/// body at rest, 1/s, by power iteration from a fixed start; from below, within some per cent. The body is
/// left as it was.
template <class Body>
double spectral_radius(Body& body) {
  constexpr int D = Body::dimension;
  constexpr int sweeps = 30;
  const auto elastic = body.material->linearised();
  const double modulus = elastic.pressure_wave_modulus();
  const auto p_before = body.U.p;
  const auto P_before = body.P;
  auto& p = body.U.p;
  auto& S = body.P;

  std::mt19937_64 random(1);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (std::int64_t a = 0; a < body.size(); ++a) {
    for (double& component : p[a])
      component = number();
    S[a].setZero();
  }
  // Energies of p and of S in one unit.
  const auto norm = [&] {
    return std::sqrt(sum(body.size(), 0.0, [&](std::int64_t a) {
      return body.V[a] * (p[a].squaredNorm() / body.density + S[a].squaredNorm() / modulus);
    }));
  };
  double before = norm(), two_before = before, radius = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    body.rates();
    for_each(body.size(), [&](std::int64_t a) {
      const Mat<D>& G = body.velocity_gradient(a);
      p[a] = body.R.p[a];
      S[a] = elastic.mu * (G + G.transpose()) + elastic.lambda * G.trace() * Mat<D>::Identity();
    });
    const double now = norm();
    if (sweep > 0) // pairs of complex eigenvalues turn within two sweeps
      radius = std::sqrt(now / two_before);
    // In the next sweep's unit.
    for_each(body.size(), [&](std::int64_t a) {
      p[a] /= now;
      S[a] /= now;
    });
    two_before = before / now;
    before = 1;
  }
  p = p_before;
  S = P_before;
  return radius;
}

/// The longest way, m, a pressure wave may go in a step of Heun's method: real eigenvalues -r are stable up
/// to 2 / r, and four fifths of it are taken. The radius grows with the wave speeds as the body deforms.
template <class Body>
double stable_length(Body& body) {
  return 0.8 * 2 / spectral_radius(body) * body.wave_speed;
}

} // namespace tessera::solver
