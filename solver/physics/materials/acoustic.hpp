/// Plane waves of small amplitude in a strained elastic body: rho0 c^2 m = Q m with the acoustic tensor
/// Q_ij = dP_iI/dF_jJ N_I N_J, (2.15), N the direction of travel in the reference configuration.
#pragma once

#include "core/tensor.hpp"
#include "solver/physics/law.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace tessera::solver {

/// dP/dF at one F, as a 9 x 9 matrix over the components of P and F stored column by column, Pa.
class Elasticity {
 public:
  using Matrix = Eigen::Matrix<double, 9, 9>;

  explicit Elasticity(const Matrix& dP_dF) : A_(dP_dF) {}

  /// Q of waves along the unit vector N, Pa.
  Mat3 acoustic(const Vec3& N) const {
    Mat3 Q = Mat3::Zero();
    for (int I = 0; I < 3; ++I)
      for (int J = 0; J < 3; ++J)
        Q += N[I] * N[J] * A_.block<3, 3>(3 * I, 3 * J);
    return Q;
  }

  /// The same form read for a given polarisation m: m.Q(N).m = N.polarised(m).N, Pa.
  Mat3 polarised(const Vec3& m) const {
    Mat3 B;
    for (int I = 0; I < 3; ++I)
      for (int J = 0; J < 3; ++J)
        B(I, J) = m.dot(A_.block<3, 3>(3 * I, 3 * J) * m);
    return B;
  }

  const Matrix& matrix() const { return A_; }

 private:
  Matrix A_;
};

/// Of a stress piola(F) by central differences of sixth order in each component of F. Measured on the laws
/// here at stretches of 0.3 to 3: within 5e-12 of the stiffest entry.
template <class Piola>
Elasticity elasticity_of(const Piola& piola, const Mat3& F) {
  const double h =
      1e-3 *
      std::sqrt(
          Eigen::SelfAdjointEigenSolver<Mat3>(F.transpose() * F, Eigen::EigenvaluesOnly).eigenvalues()[0]);
  constexpr std::array weight = {0.75, -0.15, 1.0 / 60};
  Elasticity::Matrix A = Elasticity::Matrix::Zero();
  for (int k = 0; k < 9; ++k)
    for (int step = 1; step <= 3; ++step) {
      Mat3 plus = F, minus = F;
      plus.data()[k] += step * h;
      minus.data()[k] -= step * h;
      const Mat3 difference = weight[static_cast<std::size_t>(step - 1)] / h * (piola(plus) - piola(minus));
      A.col(k) += Eigen::Map<const Eigen::Matrix<double, 9, 1>>(difference.data());
    }
  return Elasticity(A);
}

/// Of an elastic law, with H and J those of F.
template <ConstitutiveLaw L>
requires std::is_empty_v<typename L::History> Elasticity elasticity_of(const L& law, const Mat3& F) {
  typename L::History none;
  return elasticity_of([&](const Mat3& G) { return law.piola(Strain::of(G), none); }, F);
}

/// rho0 c^2 of the three waves along N, the slowest first, Pa: two shear waves and the pressure wave. A
/// negative one is no wave: the equations are not hyperbolic there.
inline Vec3 wave_moduli(const Mat3& acoustic) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(0.5 * (acoustic + acoustic.transpose()), Eigen::EigenvaluesOnly)
      .eigenvalues();
}

/// Speed in the reference configuration, m/s; not a number where there is no wave. (2.16)
inline double wave_speed(double modulus, double density) {
  return modulus < 0 ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(modulus / density);
}

} // namespace tessera::solver
