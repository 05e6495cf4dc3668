/// What a constitutive law offers to a body.
#pragma once

#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/physics/strain.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

namespace tessera::solver {

/// An aggregate of constants with
///   History                         what a particle remembers; empty for elastic laws
///   piola(strain, history)          first Piola-Kirchhoff stress, Pa; advances the history
///   energy(strain, history)         stored energy, J/m^3, with piola its derivative at a fixed history
///   linearised()                    moduli of small strains about the undeformed state
/// The area and volume maps come as fields of their own: a law takes them from the strain, not from F.
template <class L>
concept ConstitutiveLaw = requires(const L law, const Strain& strain, typename L::History& history) {
  { law.piola(strain, history) } -> std::same_as<Mat3>;
  { law.energy(strain, history) } -> std::same_as<double>;
  { law.linearised() } -> std::same_as<ElasticConstants>;
};

/// A law that knows how stiff it is under strain: stiffened_modulus(strain, squared_stretches(strain.F)), Pa,
/// the largest rho0 c^2 of pressure waves along the principal directions. With the undeformed modulus over
/// the smallest stretch squared it bounds the waves of all directions (tested at stretches of 0.3 to 3).
template <class L>
concept StiffeningLaw = ConstitutiveLaw<L> &&
    requires(const L law, const Strain& strain, const Vec3& squared) {
  { law.stiffened_modulus(strain, squared) } -> std::same_as<double>;
};

/// rho0 c^2, Pa, that no wave of the strained body exceeds: the undeformed modulus over the smallest stretch
/// squared, (3.93), or what the law says of itself where it has stiffened more.
template <ConstitutiveLaw L>
double largest_wave_modulus(const L& law, const Strain& strain) {
  const Vec3 squared = squared_stretches(strain.F);
  const double usual = law.linearised().pressure_wave_modulus() / squared[0];
  if constexpr (StiffeningLaw<L>)
    return std::max(usual, law.stiffened_modulus(strain, squared));
  else
    return usual;
}

/// rho0 c^2, Pa, that the step is taken from: (3.93) as it stands while no wave is faster than that by more
/// than a quarter, for which a CFL number of 0.3 leaves room; else the law's own.
template <ConstitutiveLaw L>
double step_wave_modulus(const L& law, const Strain& strain, const Vec3& squared) {
  const double usual = law.linearised().pressure_wave_modulus() / squared[0];
  if constexpr (StiffeningLaw<L>) {
    const double own = law.stiffened_modulus(strain, squared);
    return own > 1.25 * 1.25 * usual ? own : usual;
  } else {
    return usual;
  }
}
template <ConstitutiveLaw L>
double step_wave_modulus(const L& law, const Strain& strain) {
  return step_wave_modulus(law, strain, squared_stretches(strain.F));
}

/// A law that also flows: elastic_piola(strain, history), Pa, as if it did not;
/// equivalent_plastic_strain(history) and plastic_work(history), J/m^3.
template <class L>
concept PlasticLaw = ConstitutiveLaw<L> &&
    requires(const L law, const Strain& strain, const typename L::History& history) {
  { law.elastic_piola(strain, history) } -> std::same_as<Mat3>;
  { law.equivalent_plastic_strain(history) } -> std::same_as<double>;
  { law.plastic_work(history) } -> std::same_as<double>;
};

/// First Piola-Kirchhoff stress, Pa, of a strain that leads to no further flow.
template <ConstitutiveLaw L>
Mat3 elastic_piola(const L& law, const Strain& strain, const typename L::History& history) {
  if constexpr (PlasticLaw<L>) {
    return law.elastic_piola(strain, history);
  } else {
    typename L::History same = history;
    return law.piola(strain, same);
  }
}

/// Its change, Pa, by a small change of the strain with the displacement gradient grad_u, by central
/// differences; H and J change with F.
template <ConstitutiveLaw L>
Mat3 differential(const L& law, const typename L::History& history, const Strain& strain,
                  const Mat3& grad_u) {
  const double size = grad_u.norm();
  if (size == 0)
    return Mat3::Zero();
  const Mat3 F_grad_u = cross(strain.F, grad_u);
  const double H_grad_u = strain.H.cwiseProduct(grad_u).sum();
  const double small = 1e-6 * std::sqrt(squared_stretches(strain.F)[0]) / size;
  const auto piola = [&](double h) {
    return elastic_piola(law, {strain.F + h * grad_u, strain.H + h * F_grad_u, strain.J + h * H_grad_u},
                         history);
  };
  return (piola(small) - piola(-small)) / (2 * small);
}

/// Zero for elastic laws.
template <ConstitutiveLaw L>
double equivalent_plastic_strain(const L& law, const typename L::History& history) {
  if constexpr (PlasticLaw<L>)
    return law.equivalent_plastic_strain(history);
  else
    return 0;
}

/// Work spent on plastic flow so far, J/m^3; zero for elastic laws.
template <ConstitutiveLaw L>
double plastic_work(const L& law, const typename L::History& history) {
  if constexpr (PlasticLaw<L>)
    return law.plastic_work(history);
  else
    return 0;
}

} // namespace tessera::solver
