/// A body of particles: its fields, its material, and the rates of section 3.4, (3.82) and (3.90).
#pragma once

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solver/operators/gradient.hpp"
#include "solver/physics/formulation.hpp"
#include "solver/physics/material.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace tessera::solver {

/// Thrown where a particle's state stops making sense; whoever runs the body turns it into a RunError.
struct Breakdown {
  std::int64_t particle;
  double J; ///< volume ratio at the particle; not positive, or positive where another field is not finite
};

/// What a body needs beside its fields.
template <int D, class Dissipation>
struct BodyParts {
  std::vector<Vec<D>> X; ///< reference positions, m
  std::vector<double> V; ///< subvolumes, m^3
  double density;        ///< reference density, kg/m^3
  std::unique_ptr<Material<D>> material;
  Neighbours neighbours;
  Gradient<D> gradient;
  Dissipation dissipation;
  double involution = 0; ///< xi of the penalty that ties J to det F and H to cof F, over `delta`
  double delta = 1;      ///< smallest particle distance, m
};

template <class Formulation_, class Dissipation>
class Body {
 public:
  using Formulation = Formulation_;
  static constexpr int dimension = Formulation::dimension, D = dimension;
  static constexpr bool dissipates = Dissipation::active;
  static constexpr bool dissipates_J = Dissipation::of_J;
  static_assert(Formulation::evolves_J || !dissipates_J);
  static constexpr bool nets_J = Dissipation::nets_J;

  /// At rest at the reference positions.
  explicit Body(BodyParts<D, Dissipation> parts)
      : V(std::move(parts.V)), density(parts.density),
        wave_speed(std::sqrt(parts.material->linearised().pressure_wave_modulus() / parts.density)),
        material(std::move(parts.material)), neighbours(std::move(parts.neighbours)),
        gradient(std::move(parts.gradient)), dissipation(std::move(parts.dissipation)), U(V.size()),
        R(V.size()), P(V.size(), Mat<D>::Zero()), T(V.size(), Vec<D>::Zero()), wave(V.size(), wave_speed),
        involution_(parts.involution / parts.delta) {
    U.x = std::move(parts.X);
    dissipation.allocate(V.size());
    if constexpr (!Formulation::evolves_F)
      gradient_of_x_.assign(V.size(), Mat<D>::Identity());
    commit();
  }

  std::int64_t size() const { return static_cast<std::int64_t>(V.size()); }

  /// Positions are now x. Fields of strain begin with `gradients`, where these are known better than the
  /// particles' positions tell: what the operators miss of a smooth F is then missed in its changes only.
  /// Else they follow by the discrete gradient, so that F and x agree in what the operators see, (2.169).
  void deform(std::vector<Vec<D>> x, const std::vector<Mat<D>>& gradients = {}) {
    U.x = std::move(x);
    for_each(size(), [&](std::int64_t a) {
      const Mat<D> F = gradients.empty() ? gradient_of(U.x, a) : gradients[a];
      if constexpr (Formulation::evolves_F)
        U.F[a] = F;
      if constexpr (Formulation::evolves_H)
        U.H[a] = cofactor(embed(F));
      if constexpr (Formulation::evolves_J)
        U.J[a] = F.determinant();
    });
  }

  /// R = rates of U: dx/dt = v, dF/dt = G = grad v, dH/dt = F x G, dJ/dt = H : G and dp/dt = T + D, as far as
  /// U has them, with T alone kept beside it. P must belong to U.
  void rates() {
    strain_rates();
    momentum_rates();
  }

  /// The first sweep over the edges gathers v for G and what the dissipation wants first.
  void strain_rates() {
    for_each(size(), [&](std::int64_t a) {
      Mat<D> G = Mat<D>::Zero();
      if constexpr (Formulation::evolves_F)
        G = -U.p[a] * gradient.s[a].transpose();
      auto rough = dissipation.begin_first(*this, a);
      if constexpr (Formulation::evolves_F || Dissipation::sweeps_first)
        for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
          const std::int32_t b = neighbours.column[e];
          const Vec<D>& p_b = U.p[b];
          if constexpr (Formulation::evolves_F)
            for (int c = 0; c < D; ++c)
              G.col(c) += gradient.w[e][c] * p_b;
          dissipation.add_first(rough, *this, e, b);
        }
      R.x[a] = U.p[a] / density;
      if constexpr (Formulation::evolves_F)
        R.F[a] = G / density;
      dissipation.end_first(rough, a);
      map_rates(a);
    });
  }

  /// dH/dt and dJ/dt of U by the dF/dt that is known, without dissipation.
  void map_rates() {
    for_each(size(), [&](std::int64_t a) { map_rates(a); });
  }
  void map_rates(std::int64_t a) {
    if constexpr (Formulation::evolves_J) {
      const Mat3 F = embed(U.F[a]), G = embed_rate(R.F[a]);
      const Strain of_F = Strain::of(F);
      const double pull = this->pull(a);
      if constexpr (Formulation::evolves_H) {
        R.H[a] = cross(F, G) + pull * (of_F.H - U.H[a]);
        R.J[a] = U.H[a].cwiseProduct(G).sum() + pull * (of_F.J - U.J[a]);
      } else {
        R.J[a] = of_F.H.cwiseProduct(G).sum() + pull * (of_F.J - U.J[a]);
      }
    }
  }

  /// Rate at which the penalty takes J to det F and H to cof F, 1/s.
  double pull(std::int64_t a) const { return involution_ * wave[a]; }

  /// The second sweep gathers P for T and what the dissipation goes by.
  void momentum_rates() {
    for_each(size(), [&](std::int64_t a) {
      Vec<D> divergence = P[a] * gradient.s[a];
      auto rough = dissipation.begin_second(*this, a);
      for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
        const std::int32_t b = neighbours.column[e];
        divergence += P[b] * gradient.t[e];
        dissipation.add_second(rough, *this, a, e, b);
      }
      T[a] = divergence;
      R.p[a] = divergence;
      dissipation.end_second(rough, *this, a);
    });
  }

  /// P of U with the histories as they stand: stresses within a step. Throws Breakdown.
  void stresses() {
    check();
    material->stresses(strains(), P);
    dissipation.sense(*this);
  }

  /// The step is over: the histories advance to U, P and the wave speeds follow. Throws Breakdown, before any
  /// change of the histories.
  void commit() {
    check();
    material->commit(strains(), P, wave);
    for_each(size(), [&](std::int64_t a) { wave[a] = std::sqrt(wave[a] / density); });
    dissipation.advance(*this);
    dissipation.sense(*this);
  }

  /// Largest pressure wave speed as the body is deformed, (3.93), m/s.
  double fastest_wave() const {
    return max_of(size(), 0.0, [&](std::int64_t a) { return wave[a]; });
  }

  /// Of any vectors u, one a particle.
  Mat<D> gradient_of(std::span<const Vec<D>> u, std::int64_t a) const {
    Mat<D> grad = -u[a] * gradient.s[a].transpose();
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e)
      grad += u[neighbours.column[e]] * gradient.w[e].transpose();
    return grad;
  }

  Vec<D> velocity(std::int64_t a) const { return U.p[a] / density; }
  StrainFields<D> strains() const {
    if constexpr (Formulation::evolves_F)
      return U.strain_fields();
    else
      return {gradient_of_x_, {}, {}};
  }
  Strain strain(std::int64_t a) const { return strains()[a]; }

  const std::vector<double> V; ///< subvolumes, m^3
  const double density;        ///< reference density, kg/m^3
  const double wave_speed;     ///< of pressure waves, undeformed, m/s
  std::unique_ptr<Material<D>> material;
  const Neighbours neighbours;
  const Gradient<D> gradient;
  Dissipation dissipation;

  Formulation U;            ///< the state
  Formulation R;            ///< its rates
  std::vector<Mat<D>> P;    ///< first Piola-Kirchhoff stress of U, Pa
  std::vector<Vec<D>> T;    ///< divergence of P alone, N/m^3
  std::vector<double> wave; ///< pressure wave speed at the last commit, (3.93), m/s

 private:
  void check() {
    if constexpr (!Formulation::evolves_F)
      for_each(size(), [&](std::int64_t a) { gradient_of_x_[a] = gradient_of(U.x, a); });
    for_each(size(), [&](std::int64_t a) {
      double J = strains().F[a].determinant();
      if constexpr (Formulation::evolves_J)
        J = std::min(J, U.J[a]);
      if (!(J > 0) || !std::isfinite(J) || !U.p[a].allFinite())
        throw Breakdown{a, J};
    });
  }

  double involution_;                   ///< xi / Delta, 1/m
  std::vector<Mat<D>> gradient_of_x_{}; ///< F where no field evolves it
};

} // namespace tessera::solver
