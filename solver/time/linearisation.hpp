/// From a body to the matrices of its small disturbances.
#pragma once

#include "solver/boundary/held_velocity.hpp"
#include "solver/physics/body.hpp"
#include "solver/time/linearised.hpp"
#include "solver/time/momentum_projection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tessera::solver {

/// The free directions of every particle: columns of each.
template <int D>
std::vector<Eigen::Matrix<double, D, Eigen::Dynamic>> free_directions(std::size_t n, HeldVelocities<D> held) {
  std::vector<Mat<D>> free(n);
  std::vector<Vec<D>> still(n, Vec<D>::Zero()), impulse(n, Vec<D>::Zero());
  held.apply(still, 1, 0, 0, impulse);
  for (int c = 0; c < D; ++c) {
    std::vector<Vec<D>> p(n, Vec<D>::Unit(c));
    held.apply(p, 1, 0, 0, impulse);
    for (std::size_t a = 0; a < n; ++a)
      free[a].col(c) = p[a] - still[a];
  }
  std::vector<Eigen::Matrix<double, D, Eigen::Dynamic>> directions(n);
  for (std::size_t a = 0; a < n; ++a) {
    const Eigen::SelfAdjointEigenSolver<Mat<D>> axes(free[a]);
    const auto count = (axes.eigenvalues().array() > 0.5).count();
    directions[a] = axes.eigenvectors().rightCols(count);
  }
  return directions;
}

/// Makes the matrices, column by column, by the body's own sweeps over its edges. The body is at rest, its
/// last commit that of its strains; afterwards it is as before. `projected`: by a step that conserves
/// momenta.
template <class Body>
class Linearisation {
 public:
  static constexpr int D = Body::dimension;
  using Formulation = typename Body::Formulation;

  Linearisation(Body& body, const HeldVelocities<D>& held, bool projected, double length)
      : body_(body), free_(free_directions<D>(body.V.size(), held)), projected_(projected),
        grad_u_(body.V.size()) {
    result_.length = length;
    result_.time = length / body.fastest_wave();
    for (const auto& directions : free_) {
      first_.push_back(unknowns_);
      unknowns_ += directions.cols();
    }
  }

  Linearised operator()() {
    if constexpr (Formulation::evolves_J)
      begin_J();
    result_.K.resize(unknowns_, unknowns_);
    result_.C.resize(unknowns_, unknowns_);
    for (std::int64_t a = 0; a < body_.size(); ++a)
      for (Eigen::Index k = 0; k < free_[a].cols(); ++k)
        motion(a, k);
    if constexpr (Formulation::evolves_J)
      for (std::int64_t a = 0; a < body_.size(); ++a)
        volume(a);
    body_.stresses();
    return std::move(result_);
  }

 private:
  /// What a unit of velocity, and of displacement, in a free direction does.
  void motion(std::int64_t a, Eigen::Index k) {
    const Eigen::Index column = first_[a] + k;
    std::vector<Vec<D>> p(body_.V.size(), Vec<D>::Zero());
    p[a] = free_[a].col(k) / std::sqrt(body_.V[a]);
    for_each(body_.size(), [&](std::int64_t b) { grad_u_[b] = body_.gradient_of(p, b); });
    if constexpr (Formulation::evolves_J)
      for_each(body_.size(), [&](std::int64_t b) {
        result_.G(b, column) = result_.length * cofactor_of(b).cwiseProduct(embed_rate(grad_u_[b])).sum();
      });
    body_.sweep_momenta(p, std::vector<double>(body_.V.size(), 0.0), nothing);
    body_.send_stresses([&](std::int64_t first, std::span<Mat<D>> P) {
      body_.material->differentials(body_.strains(), grad_u_, first, P);
      if constexpr (Formulation::evolves_J)
        for (std::size_t i = 0; i < P.size(); ++i) {
          const std::int64_t b = first + static_cast<std::int64_t>(i);
          P[i] -= result_.G(b, column) / result_.length * by_J_[b];
        }
    });
    body_.sweep_stresses();
    auto& dissipated = body_.R.p; // T and D apart; both are linear in what they come from
    for_each(body_.size(), [&](std::int64_t b) { dissipated[b] -= body_.T[b]; });
    const double t = result_.time;
    result_.C.col(column) = -t * accelerations(dissipated);
    result_.K.col(column) = -t * t / body_.density * accelerations(body_.T);
  }

  /// What a unit of J at a particle does.
  void volume(std::int64_t a) {
    const std::vector<Vec<D>> still(body_.V.size(), Vec<D>::Zero());
    std::vector<double> J(body_.V.size(), 0.0);
    J[a] = 1;
    body_.sweep_momenta(still, J, nothing);
    body_.send_stresses([&](std::int64_t first, std::span<Mat<D>> P) {
      std::fill(P.begin(), P.end(), Mat<D>::Zero());
      if (a >= first && a < first + static_cast<std::int64_t>(P.size()))
        P[static_cast<std::size_t>(a - first)] = by_J_[a];
    });
    body_.sweep_stresses();
    if constexpr (Body::nets_J)
      if (projected_)
        project_volume(body_.R.J, body_.V);
    const double t = result_.time;
    result_.B.col(a) = t * t / (result_.length * body_.density) * accelerations(body_.T);
    for_each(body_.size(),
             [&](std::int64_t b) { result_.D(b, a) = Body::dissipates_J ? t * body_.R.J[b] : 0; });
  }

  /// dP/dJ of every particle by itself, Pa, by central differences.
  void begin_J() {
    constexpr double small = 1e-6;
    const std::int64_t n = body_.size();
    by_J_.resize(body_.V.size());
    result_.pull.resize(n);
    result_.B.resize(unknowns_, n);
    result_.G.resize(n, unknowns_);
    result_.D.resize(n, n);
    result_.evolves_H = Formulation::evolves_H;
    for_each(n, [&](std::int64_t a) {
      Strain more = body_.strain(a), less = more;
      const double step = small * more.J;
      more.J += step;
      less.J -= step;
      by_J_[a] =
          (body_.material->piola(more, a) - body_.material->piola(less, a)).template topLeftCorner<D, D>() /
          (2 * step);
      result_.pull[a] = result_.time * body_.pull_to_F(a);
    });
  }

  Mat3 cofactor_of(std::int64_t a) const { return cofactor(body_.strain(a).F); }

  /// Of forces (changed in place where they are projected) along the free directions.
  Eigen::VectorXd accelerations(std::vector<Vec<D>>& forces) const {
    if (projected_)
      project_momentum<D>(forces, body_.U.x, body_.V);
    Eigen::VectorXd along(unknowns_);
    for_each(body_.size(), [&](std::int64_t b) {
      along.segment(first_[b], free_[b].cols()) = std::sqrt(body_.V[b]) * free_[b].transpose() * forces[b];
    });
    return along;
  }

  static void nothing(std::int64_t, const Mat<D>&) {}

  Body& body_;
  std::vector<Eigen::Matrix<double, D, Eigen::Dynamic>> free_;
  bool projected_;
  std::vector<Mat<D>> grad_u_;
  std::vector<Eigen::Index> first_; ///< unknown of a particle
  Eigen::Index unknowns_ = 0;
  std::vector<Mat<D>> by_J_; ///< dP/dJ
  Linearised result_;
};

} // namespace tessera::solver
