/// How long a step the semi-discrete system itself bears.
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace tessera::solver {

/// The step from which on the Verlet method, with its dissipation half a step behind, amplifies some field:
/// for d2p/dt2 = -K p - C dp/dt it is the dt at which the largest eigenvalue of dt^2 K + 2 dt C is 4. K is
/// the linearisation about the body as it is strained, without further flow, C its dissipation as strong as
/// it is now. Where J is dissipated too, by C_J and a step behind, a mode that both see bears dt^2 K =
/// (2 - dt C) (2 - dt C_J); the roughest of each are taken for the same. Power iteration, from above: what
/// thirty sweeps from a random field have found is some per cent too long. The field is kept, so that a few
/// sweeps follow the body as it deforms.
template <class Body>
class CriticalStep {
 public:
  static constexpr int D = Body::dimension;

  double value() const { return value_; } ///< s
  /// Of the field found: Rayleigh's quotients sqrt(K), rad/s, and C, 1/s.
  double frequency() const { return frequency_; }
  double decay() const { return decay_; }

  /// Sweeps over all edges. The body is as before afterwards.
  void refine(Body& body, int sweeps) {
    stir(field_, body.V.size());
    if constexpr (Body::dissipates_J)
      stir(field_J_, body.V.size());
    const auto pull = body.pull;
    const auto T = body.T;
    const auto R = body.R;
    std::vector<Mat<D>> grad_u(body.V.size());
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      body.sweep_momenta(field_, field_J_, [&](std::int64_t a, const Mat<D>& G) {
        grad_u[a] = Body::Formulation::evolves_F ? G : Mat<D>(body.gradient_of(field_, a) / body.density);
      });
      body.send_stresses([&](std::int64_t first, std::span<Mat<D>> dP) {
        body.material->differentials(body.strains(), grad_u, first, dP);
      });
      body.sweep_stresses();
      improve(body);
    }
    body.pull = pull;
    body.T = T;
    body.R = R;
  }

 private:
  /// A field that has converged to one place would not see another become stiffer.
  void stir(std::vector<Vec<D>>& field, std::size_t n) {
    const double share = field.empty() ? 1 : 0.1;
    field.resize(n, Vec<D>::Zero());
    for (Vec<D>& u : field)
      for (double& component : u)
        component += share * random();
  }
  void stir(std::vector<double>& field, std::size_t n) {
    const double share = field.empty() ? 1 : 0.1;
    field.resize(n, 0.0);
    for (double& J : field)
      J += share * random();
  }
  double random() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1; } ///< from -1 to 1

  /// T = -K p and R.p - T = -C p of the field p have been found.
  void improve(const Body& body) {
    using Sums = Eigen::Vector4d; // p.p, p.Kp, p.Cp, 1.1
    const Sums sums = sum(body.size(), Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
      const Vec<D>&p = field_[a], T = body.T[a];
      return body.V[a] * Sums(p.squaredNorm(), -p.dot(T), -p.dot(body.R.p[a] - T), 1);
    });
    const double K = std::max(sums[1] / sums[0], 0.0), C = std::max(sums[2] / sums[0], 0.0);
    const double C_J = improve_J(body);
    const double dt = 4 / (C + C_J + std::sqrt((C - C_J) * (C - C_J) + 4 * K));
    value_ = dt;
    frequency_ = std::sqrt(K);
    decay_ = C;
    const double unit = 0.25 * std::sqrt(sums[3] / sums[0]);
    for_each(body.size(), [&](std::int64_t a) {
      field_[a] = -unit * (dt * dt * body.T[a] + 2 * dt * (body.R.p[a] - body.T[a]));
    });
  }

  /// Rayleigh's quotient of the dissipation of J at field_J_, 1/s, which is then made rougher.
  double improve_J(const Body& body) {
    if constexpr (Body::dissipates_J) {
      using Sums = Eigen::Vector4d; // J.J, J.CJ, CJ.CJ, 1.1
      const Sums sums = sum(body.size(), Sums(Sums::Zero()), [&](std::int64_t a) -> Sums {
        const double J = field_J_[a], rate = body.R.J[a];
        return body.V[a] * Sums(J * J, -J * rate, rate * rate, 1);
      });
      const double unit = std::sqrt(sums[3] / sums[2]);
      if (std::isfinite(unit))
        for_each(body.size(), [&](std::int64_t a) { field_J_[a] = -unit * body.R.J[a]; });
      return std::max(sums[1] / sums[0], 0.0);
    } else {
      return 0;
    }
  }

  std::vector<double> field_J_; ///< of the volume map, that its dissipation takes first, of mean square 1
  std::vector<Vec<D>> field_;   ///< momenta that grow first, of mean square 1
  std::mt19937_64 random_{1};
  double value_ = 0, frequency_ = 0, decay_ = 0;
};

} // namespace tessera::solver
