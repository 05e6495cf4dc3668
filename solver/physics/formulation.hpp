/// The formulations: each owns the fields it evolves, and nothing else. Also the types of their rates.
#pragma once

#include "core/tensor.hpp"
#include "solver/physics/strain.hpp"

#include <span>
#include <tuple>
#include <vector>

namespace tessera::solver {

/// Linear momentum and position of every particle: what all formulations evolve.
template <int D>
struct Motion {
  static constexpr int dimension = D;

  std::vector<Vec<D>> x; ///< current position, m
  std::vector<Vec<D>> p; ///< linear momentum per reference volume, kg/(m^2 s)

  explicit Motion(std::size_t n) : x(n, Vec<D>::Zero()), p(n, Vec<D>::Zero()) {}
};

/// Total-Lagrangian corrected SPH in displacements, the baseline: F = grad x is no unknown.
template <int D>
struct Displacement : Motion<D> {
  static constexpr const char* name = "displacement";
  static constexpr const char* title = "{x, p}";
  static constexpr bool evolves_F = false, evolves_H = false, evolves_J = false;

  auto strains() { return std::tie(); }
  auto strains() const { return std::tie(); }

  explicit Displacement(std::size_t n = 0) : Motion<D>(n) {}
};

/// {p, F}: the deformation gradient is evolved, H and J come from it.
template <int D>
struct PF : Motion<D> {
  static constexpr const char* name = "pF";
  static constexpr const char* title = "{p, F}";
  static constexpr bool evolves_F = true, evolves_H = false, evolves_J = false;

  std::vector<Mat<D>> F; ///< deformation gradient, -

  auto strains() { return std::tie(F); }
  auto strains() const { return std::tie(F); }
  StrainFields<D> strain_fields() const { return {F, {}, {}}; }

  explicit PF(std::size_t n = 0) : Motion<D>(n), F(n, Mat<D>::Identity()) {}
};

/// {p, F, J}: the volume map too.
template <int D>
struct PFJ : Motion<D> {
  static constexpr const char* name = "pFJ";
  static constexpr const char* title = "{p, F, J}";
  static constexpr bool evolves_F = true, evolves_H = false, evolves_J = true;

  std::vector<Mat<D>> F; ///< deformation gradient, -
  std::vector<double> J; ///< volume map, -

  auto strains() { return std::tie(F, J); }
  auto strains() const { return std::tie(F, J); }
  StrainFields<D> strain_fields() const { return {F, {}, J}; }

  explicit PFJ(std::size_t n = 0) : Motion<D>(n), F(n, Mat<D>::Identity()), J(n, 1.0) {}
};

/// {p, F, H, J}: the area map too; of three dimensions in the plane as well, where H_33 is an area of it.
template <int D>
struct PFHJ : Motion<D> {
  static constexpr const char* name = "pFHJ";
  static constexpr const char* title = "{p, F, H, J}";
  static constexpr bool evolves_F = true, evolves_H = true, evolves_J = true;

  std::vector<Mat<D>> F; ///< deformation gradient, -
  std::vector<Mat3> H;   ///< area map, -
  std::vector<double> J; ///< volume map, -

  auto strains() { return std::tie(F, H, J); }
  auto strains() const { return std::tie(F, H, J); }
  StrainFields<D> strain_fields() const { return {F, H, J}; }

  explicit PFHJ(std::size_t n = 0)
      : Motion<D>(n), F(n, Mat<D>::Identity()), H(n, Mat3::Identity()), J(n, 1.0) {}
};

} // namespace tessera::solver
