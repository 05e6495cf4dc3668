/// What a frame shows beside the usual fields, where the case asks for it: each is computed from one
/// particle's state, and only for the frames that are written.
#pragma once

#include "core/tensor.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::solver {

struct MaterialPoint {
  Mat3 F;        ///< deformation gradient
  Mat3 sigma;    ///< Cauchy stress, Pa
  double energy; ///< stored elastic energy per reference volume, J/m^3
  double wave;   ///< fastest wave per reference length, m/s: what (3.93) divides the spacing by
};

struct DerivedField {
  std::string_view name;
  int components; ///< 1, or 9: a tensor row by row
  void (*compute)(const MaterialPoint& point, double* out);
};

/// All there are:
///   PrincipalStress1..3   eigenvalues of the Cauchy stress, the largest first, Pa
///   PrincipalStretch1..3  singular values of F, the largest first
///   Triaxiality           tr(sigma)/3 over von Mises' stress: 1/3 in tension, 0 in shear; 0 without deviator
///   LodeAngle             theta in cos 3 theta = 27/2 J3 / vonMises^3: 0 in tension, 30 in shear, 60 in
///                         compression, degrees; 0 without deviator
///   StrainEnergy          stored energy per reference volume, J/m^3
///   WaveSpeed             m/s
///   DeformationGradient   F, nine components row by row
std::span<const DerivedField> derived_fields();

/// Their names.
std::vector<std::string> derived_field_names();

/// The field of that name; nullptr where there is none.
const DerivedField* find_derived_field(std::string_view name);

} // namespace tessera::solver
