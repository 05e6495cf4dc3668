#include "solver/physics/derived_fields.hpp"

#include "solver/physics/stress_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::solver {
namespace {

template <int i>
void principal_stress(const MaterialPoint& point, double* out) {
  *out = Eigen::SelfAdjointEigenSolver<Mat3>(point.sigma, Eigen::EigenvaluesOnly).eigenvalues()[3 - i];
}

template <int i>
void principal_stretch(const MaterialPoint& point, double* out) {
  const Mat3 C = point.F.transpose() * point.F;
  const double square = Eigen::SelfAdjointEigenSolver<Mat3>(C, Eigen::EigenvaluesOnly).eigenvalues()[3 - i];
  *out = std::sqrt(std::max(square, 0.0));
}

/// Below this share of the stress a deviator is rounding.
constexpr double rounding = 1e-12;

void triaxiality(const MaterialPoint& point, double* out) {
  const double q = von_mises(point.sigma);
  *out = q > rounding * point.sigma.norm() ? pressure(point.sigma) / q : 0;
}

void lode_angle(const MaterialPoint& point, double* out) {
  const double q = von_mises(point.sigma);
  *out = 0;
  if (!(q > rounding * point.sigma.norm()))
    return;
  const Mat3 deviator = (point.sigma - pressure(point.sigma) * Mat3::Identity()) / q;
  *out = std::acos(std::clamp(13.5 * deviator.determinant(), -1.0, 1.0)) / 3 * 180 / M_PI;
}

constexpr std::array<DerivedField, 11> all{{
    {"PrincipalStress1", 1, principal_stress<1>},
    {"PrincipalStress2", 1, principal_stress<2>},
    {"PrincipalStress3", 1, principal_stress<3>},
    {"PrincipalStretch1", 1, principal_stretch<1>},
    {"PrincipalStretch2", 1, principal_stretch<2>},
    {"PrincipalStretch3", 1, principal_stretch<3>},
    {"Triaxiality", 1, triaxiality},
    {"LodeAngle", 1, lode_angle},
    {"StrainEnergy", 1, [](const MaterialPoint& point, double* out) { *out = point.energy; }},
    {"WaveSpeed", 1, [](const MaterialPoint& point, double* out) { *out = point.wave; }},
    {"DeformationGradient", 9,
     [](const MaterialPoint& point, double* out) {
       Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{out} = point.F;
     }},
}};

} // namespace

std::span<const DerivedField> derived_fields() {
  return all;
}

std::vector<std::string> derived_field_names() {
  std::vector<std::string> names;
  for (const DerivedField& field : all)
    names.emplace_back(field.name);
  return names;
}

const DerivedField* find_derived_field(std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const DerivedField& field) { return field.name == name; });
  return found == all.end() ? nullptr : &*found;
}

} // namespace tessera::solver
