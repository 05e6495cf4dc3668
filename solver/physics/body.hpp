/// A body of particles: its fields, its material, and the rates of section 3.4, (3.82) and (3.90).
#pragma once

#include "core/error.hpp"
#include "core/lanes.hpp"
#include "core/parallel.hpp"
#include "solver/operators/gradient.hpp"
#include "solver/physics/formulation.hpp"
#include "solver/physics/material.hpp"

#include <array>
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
  double density;        ///< reference density, kg/m^3
  std::unique_ptr<Material<D>> material;
  Neighbours neighbours;
  Gradient<D> gradient;
  Dissipation dissipation;
  double involution = 0; ///< xi of the penalty that ties J to det F and H to cof F, over `delta`
  double delta = 1;      ///< smallest particle distance, m
};

/// Two sweeps over the edges make the rates. In each a particle reads what its neighbours have sent: momenta
/// in the first, stresses in the second, laid out as the loops want them.
template <class Formulation_, class Dissipation>
class Body {
 public:
  using Formulation = Formulation_;
  static constexpr int dimension = Formulation::dimension, D = dimension;
  static constexpr bool dissipates = Dissipation::active;
  static constexpr bool dissipates_J = Dissipation::of_J;
  static_assert(Formulation::evolves_J || !dissipates_J);
  static constexpr bool nets_J = Dissipation::nets_J;

  using Field = typename Dissipation::Field; ///< p, and J where it is dissipated
  using Moments = typename Dissipation::Moments;
  using Reach = typename Dissipation::Reach;
  /// What P does at the ends of an edge: P_a (V w_ab) = [P B | P] . reach, columns in turn.
  using Pull = Lanes<D, 2 * D>;

  /// At rest at the reference positions.
  explicit Body(BodyParts<D, Dissipation> parts)
      : density(parts.density),
        wave_speed(std::sqrt(parts.material->linearised().pressure_wave_modulus() / parts.density)),
        material(std::move(parts.material)), neighbours(std::move(parts.neighbours)),
        gradient(std::move(parts.gradient)), V(gradient.V), dissipation(std::move(parts.dissipation)),
        U(V.size()), sent(V.size(), Field::Zero()), pull(V.size(), Pull::Zero()), T(V.size(), Vec<D>::Zero()),
        wave(V.size(), wave_speed), involution_(parts.involution / parts.delta) {
    U.x = std::move(parts.X);
    R.p = T;
    if constexpr (dissipates_J)
      R.J.assign(V.size(), 0.0);
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

  /// The first sweep gathers the momenta (and J, where it is dissipated) for what the dissipation wants first
  /// and calls use(a, G) with the velocity gradient G (1/s) of every particle, which may change U there.
  template <class Use>
  void sweep_momenta(std::span<const Vec<D>> p, std::span<const double> J, Use&& use) {
    for_each(size(), [&](std::int64_t a) {
      sent[a].template head<D>() = p[a];
      if constexpr (dissipates_J)
        sent[a][D] = J[a];
    });
    for_each(size(), [&](std::int64_t a) {
      typename Dissipation::First rough;
      Moments by_X, by_lambda;
      if constexpr (Formulation::evolves_F || Dissipation::fits || Dissipation::gathers)
        gather_momenta(a, by_X, by_lambda, rough);
      dissipation.end_first(rough, by_X, *this, a);
      Mat<D> G;
      if constexpr (Formulation::evolves_F) {
        const Mat<D>& B = gradient.B[a];
        const double scale = 1 / (density * V[a]);
        for (int j = 0; j < D; ++j) {
          Field column = by_lambda.col(j);
          for (int i = 0; i < D; ++i)
            column += by_X.col(i) * B(j, i);
          G.col(j) = scale * column.template head<D>();
        }
      }
      use(a, G);
    });
  }
  template <class Use>
  void sweep_momenta(const Formulation& of, Use&& use) {
    if constexpr (Formulation::evolves_J)
      sweep_momenta(of.p, of.J, use);
    else
      sweep_momenta(of.p, {}, use);
  }

  /// The second sweep gathers the stresses for T = div P and what the dissipation goes by: R is T and the
  /// dissipation of the last first sweep's fields.
  void sweep_stresses() {
    for_each(size(), [&](std::int64_t a) {
      const Field here = sent[a];
      Reach total = Reach::Zero();
      Lanes<D> force = Lanes<D>::Zero();
      typename Dissipation::Second rough;
      for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
        const std::int32_t b = neighbours.column[e];
        const Reach reach = gradient.reach(a, e, b);
        total += reach;
        force += pulled(pull[b], reach);
        dissipation.add_second(rough, a, e, b, sent[b] - here, static_cast<double>(gradient.omega[e]), reach);
      }
      T[a] = (1 / V[a]) * (force + pulled(pull[a], total)).template head<D>();
      R.p[a] = T[a];
      if constexpr (dissipates) {
        const Field lost = dissipation.end_second(rough, total, *this, a);
        R.p[a] += lost.template head<D>();
        if constexpr (dissipates_J)
          R.J[a] = lost[D];
      }
    });
  }

  /// R and T of U, whose stresses have been sent.
  void rates() {
    sweep_momenta(U, [](std::int64_t, const Mat<D>&) {});
    sweep_stresses();
  }

  /// dH/dt and dJ/dt at a particle of a state, what the motion asks for and what the penalty adds.
  struct MapRates {
    Mat3 H, H_pull;
    double J, J_pull;
  };
  MapRates map_rates(const Formulation& of, std::int64_t a, const Mat<D>& velocity_gradient) const {
    const Mat3 F = embed(of.F[a]), G = embed_rate(velocity_gradient);
    const Strain of_F = Strain::of(F);
    const double pull_a = pull_to_F(a);
    if constexpr (Formulation::evolves_H)
      return {cross(F, G), pull_a * (of_F.H - of.H[a]), of.H[a].cwiseProduct(G).sum(),
              pull_a * (of_F.J - of.J[a])};
    else
      return {{}, {}, of_F.H.cwiseProduct(G).sum(), pull_a * (of_F.J - of.J[a])};
  }
  /// Rate at which the penalty takes J to det F and H to cof F, 1/s.
  double pull_to_F(std::int64_t a) const { return involution_ * wave[a]; }

  /// P of U with the histories as they stand: stresses within a step. Throws Breakdown.
  void stresses() {
    check();
    send_stresses([&](std::int64_t first, std::span<Mat<D>> P) { material->stresses(strains(), first, P); });
    dissipation.sense(*this);
  }

  /// The step is over: the histories advance to U, P and the wave speeds follow. Throws Breakdown, before any
  /// change of the histories.
  void commit() {
    check();
    send_stresses([&](std::int64_t first, std::span<Mat<D>> P) {
      material->commit(strains(), first, P, wave);
      for (std::int64_t a = first; a < first + static_cast<std::int64_t>(P.size()); ++a)
        wave[a] = std::sqrt(wave[a] / density);
    });
    dissipation.advance(*this);
    dissipation.sense(*this);
  }

  /// Stresses, Pa, for the second sweep, that of_block(first, P) gives block by block.
  template <class OfBlock>
  void send_stresses(OfBlock&& of_block) {
    constexpr std::int64_t block = 64; // stays in the nearest cache
    for_each_block<block>(size(), [&](std::int64_t begin, std::int64_t end) {
      std::array<Mat<D>, block> P;
      of_block(begin, std::span(P).first(static_cast<std::size_t>(end - begin)));
      for (std::int64_t a = begin; a < end; ++a) {
        const Mat<D>& P_a = P[static_cast<std::size_t>(a - begin)];
        const Mat<D> PB = P_a * gradient.B[a];
        for (int j = 0; j < D; ++j) {
          pull[a].col(2 * j).template head<D>() = PB.col(j);
          pull[a].col(2 * j + 1).template head<D>() = P_a.col(j);
        }
      }
    });
  }

  /// First Piola-Kirchhoff stress as last sent, Pa.
  Mat<D> P(std::int64_t a) const {
    Mat<D> P_a;
    for (int j = 0; j < D; ++j)
      P_a.col(j) = pull[a].col(2 * j + 1).template head<D>();
    return P_a;
  }

  /// Largest pressure wave speed as the body is deformed, (3.93), m/s.
  double fastest_wave() const {
    return max_of(size(), 0.0, [&](std::int64_t a) { return wave[a]; });
  }

  /// Of any vectors u, one a particle.
  Mat<D> gradient_of(std::span<const Vec<D>> u, std::int64_t a) const {
    Mat<D> by_X = Mat<D>::Zero(), by_lambda = by_X;
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
      const std::int32_t b = neighbours.column[e];
      const Reach reach = gradient.reach(a, e, b);
      const Vec<D> change = u[b] - u[a];
      by_X += change * reach.col(0).template head<D>().transpose();
      by_lambda += change * reach.col(1).template head<D>().transpose();
    }
    return (by_X * gradient.B[a].transpose() + by_lambda) / V[a];
  }

  Vec<D> velocity(std::int64_t a) const { return U.p[a] / density; }
  StrainFields<D> strains() const { return strains(U); }
  /// Of U or of an earlier state. Where F is not evolved: as at the last stresses.
  StrainFields<D> strains(const Formulation& of) const {
    if constexpr (Formulation::evolves_F)
      return of.strain_fields();
    else
      return {gradient_of_x_, {}, {}};
  }
  Strain strain(std::int64_t a) const { return strains()[a]; }

  const double density;    ///< reference density, kg/m^3
  const double wave_speed; ///< of pressure waves, undeformed, m/s
  std::unique_ptr<Material<D>> material;
  const Neighbours neighbours;
  const Gradient<D> gradient;
  const std::span<const double> V; ///< subvolumes, m^3
  Dissipation dissipation;

  Formulation U; ///< the state
  struct Rates {
    std::vector<Vec<D>> p;  ///< dp/dt = T and dissipation, N/m^3
    std::vector<double> J;  ///< of J by its dissipation alone, 1/s; empty without
  } R;                      ///< of the last second sweep
  std::vector<Field> sent;  ///< to the neighbours in the last first sweep
  std::vector<Pull> pull;   ///< stresses as sent to the neighbours, Pa
  std::vector<Vec<D>> T;    ///< divergence of P alone, N/m^3
  std::vector<double> wave; ///< pressure wave speed at the last commit, (3.93), m/s

 private:
  /// Sums over the edges of a particle of change (x) reach. They stay in registers: nothing else can see them
  /// before the loop is over.
  [[gnu::always_inline]] void gather_momenta(std::int64_t a, Moments& X, Moments& lambda,
                                             typename Dissipation::First& rough) const {
    const Field here = sent[a];
    Moments by_X = Moments::Zero(), by_lambda = Moments::Zero();
    typename Dissipation::First sum;
    const std::int64_t end = neighbours.row[a + 1];
    for (std::int64_t e = neighbours.row[a]; e < end; ++e) {
      const std::int32_t b = neighbours.column[e];
      const Field change = sent[b] - here;
      const Reach reach = gradient.reach(a, e, b);
      for (int j = 0; j < D; ++j) {
        by_X.col(j) += reach(j, 0) * change;
        if constexpr (Formulation::evolves_F)
          by_lambda.col(j) += reach(j, 1) * change;
      }
      dissipation.add_first(sum, e, change);
    }
    X = by_X;
    lambda = by_lambda;
    rough = sum;
  }

  /// Columns in pairs: the sum of each product is formed before it joins the next.
  static Lanes<D> pulled(const Pull& of, const Reach& reach) {
    Lanes<D> sum = of.col(0) * reach(0, 0) + of.col(1) * reach(0, 1);
    for (int j = 1; j < D; ++j)
      sum += of.col(2 * j) * reach(j, 0) + of.col(2 * j + 1) * reach(j, 1);
    return sum;
  }

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
