/// How long a step the semi-discrete system itself bears.
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace tessera::solver {

/// The step from which on the Verlet method, with its dissipation half a step behind, amplifies some field:
/// for d2p/dt2 = -K p - C dp/dt it is the dt at which the largest eigenvalue of dt^2 K + 2 dt C is 4. K is
/// the linearisation about the body as it is strained, without further flow, C its dissipation as strong as
/// it is now. Power iteration, from above: what thirty sweeps from a random field have found is some per cent
/// too long. The field is kept, so that a few sweeps follow the body as it deforms.
template <class Body>
class CriticalStep {
 public:
  static constexpr int D = Body::dimension;

  double value() const { return value_; } ///< s

  /// Sweeps over all edges. U, P and R of the body are as before afterwards.
  void refine(Body& body, int sweeps) {
    stir(body.V.size());
    const auto U_p = body.U.p, R_p = body.R.p, T = body.T;
    const auto P = body.P;
    const auto R_J = rates_of_J(body);
    std::vector<Mat<D>> grad_u(body.V.size());
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      body.U.p = field_;
      for_each(body.size(), [&](std::int64_t a) { grad_u[a] = body.gradient_of(field_, a) / body.density; });
      body.material->differentials(body.strains(), grad_u, body.P);
      body.strain_rates();
      body.momentum_rates();
      improve(body);
    }
    body.U.p = U_p;
    body.R.p = R_p;
    body.T = T;
    body.P = P;
    if constexpr (Body::Formulation::evolves_J)
      body.R.J = R_J;
  }

 private:
  /// A field that has converged to one place would not see another become stiffer.
  void stir(std::size_t n) {
    const double share = field_.empty() ? 1 : 0.1;
    field_.resize(n, Vec<D>::Zero());
    for (Vec<D>& u : field_)
      for (double& component : u)
        component += share * (static_cast<double>(random_() >> 11) * 0x1p-52 - 1);
  }

  static std::vector<double> rates_of_J(const Body& body) {
    if constexpr (Body::Formulation::evolves_J)
      return body.R.J;
    else
      return {};
  }

  /// T = -K p and R.p - T = -C p of the field p have been found.
  void improve(const Body& body) {
    using Sums = Eigen::Vector4d; // p.p, p.Kp, p.Cp, 1.1
    const Sums sums = sum(body.size(), Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
      const Vec<D>&p = field_[a], T = body.T[a];
      return body.V[a] * Sums(p.squaredNorm(), -p.dot(T), -p.dot(body.R.p[a] - T), 1);
    });
    const double K = std::max(sums[1] / sums[0], 0.0), C = std::max(sums[2] / sums[0], 0.0);
    const double dt = 4 / (C + std::sqrt(C * C + 4 * K));
    value_ = dt;
    const double unit = 0.25 * std::sqrt(sums[3] / sums[0]);
    for_each(body.size(), [&](std::int64_t a) {
      field_[a] = -unit * (dt * dt * body.T[a] + 2 * dt * (body.R.p[a] - body.T[a]));
    });
  }

  std::vector<Vec<D>> field_; ///< momenta that grow first, of mean square 1
  std::mt19937_64 random_{1};
  double value_ = 0;
};

} // namespace tessera::solver
