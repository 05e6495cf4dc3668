/// What a body is made of: a law with the memory of every particle. One virtual call a block of particles,
/// none a particle.
#pragma once

#include "core/tensor.hpp"
#include "solver/physics/law.hpp"
#include "solver/physics/strain.hpp"

#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace tessera::solver {

/// Stresses are those of a block of particles from `first` on, as many as P has room for; strains, histories
/// and all else those of the whole body.
template <int D>
class Material {
 public:
  virtual ~Material() = default;

  /// First Piola-Kirchhoff stresses (Pa) within a step: the histories stay as they are.
  virtual void stresses(const StrainFields<D>& strains, std::int64_t first, std::span<Mat<D>> P) const = 0;
  /// The step is over: the histories advance to the strains; P (Pa) and the moduli of the fastest waves now,
  /// rho0 c^2 (Pa), follow as the step is taken from them.
  virtual void commit(const StrainFields<D>& strains, std::int64_t first, std::span<Mat<D>> P,
                      std::span<double> wave_moduli) = 0;
  /// dP (Pa) of small changes of the strains by grad u (-), about the strains and without further flow.
  virtual void differentials(const StrainFields<D>& strains, std::span<const Mat<D>> grad_u,
                             std::int64_t first, std::span<Mat<D>> dP) const = 0;
  virtual ElasticConstants linearised() const = 0;

  /// Of particle a, for those who look at the body; P of all nine components in the plane too.
  virtual Mat3 piola(const Strain& strain, std::int64_t a) const = 0;    ///< Pa
  virtual double energy(const Strain& strain, std::int64_t a) const = 0; ///< stored, J/m^3
  virtual double plastic_work(std::int64_t a) const = 0;                 ///< spent, J/m^3
  virtual double equivalent_plastic_strain(std::int64_t a) const = 0;    ///< -
  virtual std::size_t history_bytes() const = 0;                         ///< a particle
};

template <int D, ConstitutiveLaw Law>
class MaterialOf final : public Material<D> {
 public:
  MaterialOf(Law law, std::int64_t particles)
      : law_(std::move(law)), history_(remembers ? static_cast<std::size_t>(particles) : 1) {}

  void stresses(const StrainFields<D>& strains, std::int64_t first, std::span<Mat<D>> P) const override {
    for (std::size_t i = 0; i < P.size(); ++i) {
      const std::int64_t a = first + static_cast<std::int64_t>(i);
      typename Law::History trial = history(a);
      P[i] = law_.piola(strains[a], trial).template topLeftCorner<D, D>();
    }
  }

  void commit(const StrainFields<D>& strains, std::int64_t first, std::span<Mat<D>> P,
              std::span<double> wave_moduli) override {
    std::vector<Vec3> squared(P.size());
    squared_stretches<D>(strains.F.subspan(static_cast<std::size_t>(first), P.size()), squared);
    for (std::size_t i = 0; i < P.size(); ++i) {
      const std::int64_t a = first + static_cast<std::int64_t>(i);
      const Strain strain = strains[a];
      P[i] = law_.piola(strain, history(a)).template topLeftCorner<D, D>();
      wave_moduli[a] = step_wave_modulus(law_, strain, squared[i]);
    }
  }

  void differentials(const StrainFields<D>& strains, std::span<const Mat<D>> grad_u, std::int64_t first,
                     std::span<Mat<D>> dP) const override {
    for (std::size_t i = 0; i < dP.size(); ++i) {
      const std::int64_t a = first + static_cast<std::int64_t>(i);
      dP[i] =
          differential(law_, history(a), strains[a], embed_rate(grad_u[a])).template topLeftCorner<D, D>();
    }
  }

  ElasticConstants linearised() const override { return law_.linearised(); }

  Mat3 piola(const Strain& strain, std::int64_t a) const override {
    typename Law::History trial = history(a);
    return law_.piola(strain, trial);
  }
  double energy(const Strain& strain, std::int64_t a) const override {
    return law_.energy(strain, history(a));
  }
  double plastic_work(std::int64_t a) const override { return solver::plastic_work(law_, history(a)); }
  double equivalent_plastic_strain(std::int64_t a) const override {
    return solver::equivalent_plastic_strain(law_, history(a));
  }
  std::size_t history_bytes() const override { return remembers ? sizeof(typename Law::History) : 0; }

 private:
  static constexpr bool remembers = !std::is_empty_v<typename Law::History>;

  typename Law::History& history(std::int64_t a) {
    return history_[remembers ? static_cast<std::size_t>(a) : 0];
  }
  const typename Law::History& history(std::int64_t a) const {
    return history_[remembers ? static_cast<std::size_t>(a) : 0];
  }

  Law law_;
  std::vector<typename Law::History>
      history_; ///< as of the last commit; one for all where nothing is remembered
};

} // namespace tessera::solver
