// Plastic flow at finite strain with each hardening: closed forms where they exist (uniaxial stress, plane
// stretching), an independent integration of the rate form where not (simple shear).

#include "solver/physics/plasticity/von_mises.hpp"

#include "solver/physics/plasticity/hardening.hpp"
#include "solver/physics/stress_measures.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double young = 117e9, poisson = 0.35;

template <class Hardening>
Hardening example() {
  if constexpr (std::is_same_v<Hardening, PowerHardening>)
    return {0.6e9, 0.02, 0.27};
  else
    return {0.4e9, 0.1e9};
}

Mat3 diagonal(double a, double b, double c) {
  return Vec3(a, b, c).asDiagonal();
}

Mat3 rotation(double angle) {
  return Eigen::AngleAxisd(angle, Vec3(1, -1, 2).normalized()).toRotationMatrix();
}

Mat3 shear(double gamma) {
  Mat3 F = Mat3::Identity();
  F(0, 1) = gamma;
  return F;
}

/// F of uniaxial stress tau with plastic strain `plastic`, in logarithmic strains: the axial one is
/// tau / E + plastic, the lateral ones -nu tau / E - plastic / 2.
Mat3 uniaxial(double tau, double plastic) {
  const double lateral = std::exp(-poisson * tau / young - plastic / 2);
  return diagonal(std::exp(tau / young + plastic), lateral, lateral);
}

template <class Hardening>
class VonMisesLaw : public ::testing::Test {
 protected:
  using Law = VonMises<Hardening>;
  using History = typename Law::History;

  const Law law{Hencky{ElasticConstants::from(young, poisson)}, example<Hardening>()};
  const double mu = law.hencky.elastic.mu;

  double yield(double eps) const { return law.hardening.yield_stress(eps); }
  double yield(const History& history) const { return yield(history.equivalent_plastic_strain); }
  Mat3 kirchhoff(const Mat3& F, History& history) const {
    return law.piola(Strain::of(F), history) * F.transpose();
  }
};

using Hardenings = ::testing::Types<LinearHardening, PowerHardening>;
TYPED_TEST_SUITE(VonMisesLaw, Hardenings);

} // namespace

TYPED_TEST(VonMisesLaw, FollowsTheAnalyticUniaxialPath) {
  for (const int steps : {1, 7, 100}) {
    typename TestFixture::History history;
    for (int i = 1; i <= steps; ++i) {
      const double eps = 1.5 * i / steps, expected = this->yield(eps);
      const Mat3 tau = this->kirchhoff(uniaxial(expected, eps), history);
      EXPECT_NEAR(tau(0, 0) / expected, 1, 1e-10);
      EXPECT_LT(std::abs(tau(1, 1)) / expected, 1e-10);
      EXPECT_NEAR(history.equivalent_plastic_strain, eps, 1e-12);
    }
  }
}

TYPED_TEST(VonMisesLaw, FollowsTheAnalyticUniaxialCycles) {
  // Pulled, pushed, pulled: after each reversal elastic until minus the yield stress, then flow the other
  // way; strains of flow with and without their sign.
  typename TestFixture::History history;
  double eps = 0, plastic = 0, tau_now = 0;
  for (const double direction : {1.0, -1.0, 1.0, -1.0}) {
    for (const double part : {0.5, 0.99}) { // not yet yielding
      const double tau = tau_now + part * (direction * this->yield(eps) - tau_now);
      EXPECT_NEAR(this->kirchhoff(uniaxial(tau, plastic), history)(0, 0), tau, 1e-10 * this->yield(0));
      EXPECT_NEAR(history.equivalent_plastic_strain, eps, 1e-12);
    }
    constexpr int steps = 20;
    for (int i = 1; i <= steps; ++i) {
      eps += 0.2 / steps;
      plastic += direction * 0.2 / steps;
      tau_now = direction * this->yield(eps);
      const Mat3 tau = this->kirchhoff(uniaxial(tau_now, plastic), history);
      EXPECT_NEAR(tau(0, 0) / tau_now, 1, 1e-10);
      EXPECT_LT(std::abs(tau(2, 2)) / this->yield(0), 1e-10);
      EXPECT_NEAR(history.equivalent_plastic_strain, eps, 1e-12);
    }
  }
  EXPECT_NEAR(history.equivalent_plastic_strain, 0.8, 1e-12);
}

TYPED_TEST(VonMisesLaw, FollowsTheAnalyticPlaneStretching) {
  // F = diag(e^s, e^-s, 1): the deviator keeps its direction, sqrt(3) 2 mu (s - sqrt(3)/2 eps) =
  // sigma_Y(eps).
  for (const int steps : {1, 13}) {
    typename TestFixture::History history;
    for (int i = 1; i <= steps; ++i) {
      const double eps = 0.9 * i / steps, stress = this->yield(eps);
      const double s = stress / (2 * std::sqrt(3.0) * this->mu) + std::sqrt(0.75) * eps;
      const Mat3 tau = this->kirchhoff(diagonal(std::exp(s), std::exp(-s), 1), history);
      EXPECT_NEAR(tau(0, 0) / (stress / std::sqrt(3.0)), 1, 1e-10);
      EXPECT_NEAR(tau(1, 1) / (-stress / std::sqrt(3.0)), 1, 1e-10);
      EXPECT_NEAR(history.equivalent_plastic_strain, eps, 1e-12);
    }
  }
}

namespace {

/// Simple shear by the rate form the algorithm steps through: b_e' = l b_e + b_e l^T - 2 dgamma N b_e with
/// N = 3/2 tau' / sigma_vm and, from consistency, dgamma = 2 mu N:d / (3 mu + sigma_Y'). Integrated by
/// Runge-Kutta of fourth order between the points, found by bisection, where flow begins.
template <class Law>
class ShearByRates {
 public:
  explicit ShearByRates(const Law& law) : law_(law) {}

  double eps = 0;
  Mat3 b = Mat3::Identity(); ///< elastic left Cauchy-Green tensor

  Mat3 tau() const { return tau_of(b); }

  void shear_to(double target) {
    // Elastic up to the yield surface. Just reversed, the stress is still on it: taken off first.
    const auto transported = [&](double gamma) -> Mat3 {
      return shear(gamma - gamma_) * b * shear(gamma - gamma_).transpose();
    };
    double low = gamma_ + std::copysign(1e-6, target - gamma_), high = target;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (von_mises(tau_of(transported(middle))) < law_.hardening.yield_stress(eps) ? low : high) = middle;
    }
    b = transported(high);
    // Flow to the end.
    constexpr int steps = 2000;
    const double h = (target - high) / steps;
    for (int i = 0; i < steps; ++i) {
      const auto [k1, e1] = rates(b, eps);
      const auto [k2, e2] = rates(b + 0.5 * h * k1, eps + 0.5 * h * e1);
      const auto [k3, e3] = rates(b + 0.5 * h * k2, eps + 0.5 * h * e2);
      const auto [k4, e4] = rates(b + h * k3, eps + h * e3);
      b += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      eps += h / 6 * (e1 + 2 * e2 + 2 * e3 + e4);
    }
    gamma_ = target;
  }

 private:
  Mat3 tau_of(const Mat3& left) const {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(left);
    const Vec3 e = 0.5 * eigen.eigenvalues().array().log();
    const Vec3 principal = 2 * law_.hencky.elastic.mu * (e.array() - e.mean());
    return eigen.eigenvectors() * principal.asDiagonal() * eigen.eigenvectors().transpose();
  }

  /// By shear: of b, and of the equivalent plastic strain (negative where shear runs backwards).
  std::pair<Mat3, double> rates(const Mat3& left, double strain) const {
    const double mu = law_.hencky.elastic.mu, h = 1e-5;
    const Mat3 stress = tau_of(left), N = 1.5 / von_mises(stress) * stress;
    Mat3 l = Mat3::Zero();
    l(0, 1) = 1;
    const double slope =
        (law_.hardening.yield_stress(strain + h) - law_.hardening.yield_stress(strain - h)) / (2 * h);
    const double flow = 2 * mu * N(0, 1) / (3 * mu + slope);
    return {l * left + left * l.transpose() - 2 * flow * N * left, flow};
  }

  const Law& law_;
  double gamma_ = 0;
};

} // namespace

TYPED_TEST(VonMisesLaw, SimpleShearConvergesToTheRateForm) {
  // To 1, back to -0.6, and on to 0.2. First order, for the principal axes turn within a step.
  const double ends[] = {1, -0.6, 0.2};
  ShearByRates exact(this->law);
  std::vector<Mat3> tau_exact;
  std::vector<double> eps_exact;
  for (const double end : ends) {
    exact.shear_to(end);
    tau_exact.push_back(exact.tau());
    eps_exact.push_back(exact.eps);
  }
  std::array<std::array<double, 3>, 3> tau_error{}, eps_error{};
  std::array<std::array<Mat3, 3>, 3> tau;
  for (std::size_t level = 0; level < 3; ++level) {
    typename TestFixture::History history;
    double gamma = 0;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const int steps = 200 << level;
      const double start = gamma;
      for (int i = 1; i <= steps; ++i) {
        gamma = start + (ends[leg] - start) * i / steps;
        tau[level][leg] = this->kirchhoff(shear(gamma), history);
      }
      tau_error[level][leg] = (tau[level][leg] - tau_exact[leg]).norm() / tau_exact[leg].norm();
      eps_error[level][leg] = std::abs(history.equivalent_plastic_strain / eps_exact[leg] - 1);
      EXPECT_NEAR(von_mises(tau[level][leg]) / this->yield(history), 1, 1e-10);
    }
  }
  for (std::size_t leg = 0; leg < 3; ++leg) {
    EXPECT_LT(tau_error[0][leg], 5e-3);
    EXPECT_LT(eps_error[0][leg], 4e-5);
    for (std::size_t level = 0; level < 2; ++level)
      EXPECT_NEAR(tau_error[level][leg] / tau_error[level + 1][leg], 2, 0.01);
    const Mat3 limit = 2 * tau[2][leg] - tau[1][leg];
    EXPECT_LT((limit - tau_exact[leg]).norm() / tau_exact[leg].norm(), 2e-6);
  }
}

TYPED_TEST(VonMisesLaw, FollowsTheUniaxialPathInARotatingFrame) {
  typename TestFixture::History history;
  for (int i = 1; i <= 50; ++i) {
    const double eps = 0.8 * i / 50;
    const Mat3 Q = rotation(0.1 * i);
    const Mat3 tau = Q.transpose() * this->kirchhoff(Q * uniaxial(this->yield(eps), eps), history) * Q;
    EXPECT_NEAR(tau(0, 0) / this->yield(eps), 1, 1e-10);
  }
}

TYPED_TEST(VonMisesLaw, IsHenckyBelowYieldAndRemembersNothingOfIt) {
  typename TestFixture::History history;
  Hencky::History none;
  const Strain strain = Strain::of(Mat3::Identity() + 1e-3 * diagonal(1, -0.2, 0.3));
  EXPECT_EQ(this->law.piola(strain, history), this->law.hencky.piola(strain, none));
  EXPECT_EQ(history.equivalent_plastic_strain, 0);
  EXPECT_EQ(history.plastic_metric, Symmetric::identity());
}

TYPED_TEST(VonMisesLaw, HoldsTheYieldSurfaceAndPlasticIncompressibilityOnRandomPaths) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    typename TestFixture::History history;
    Mat3 F = Mat3::Identity();
    for (int i = 0; i < 400; ++i) {
      Mat3 rate;
      for (int k = 0; k < 9; ++k)
        rate.data()[k] = number(random);
      // Small and large steps, drawn back to the volume it began with.
      F = (Mat3::Identity() + (i % 7 == 0 ? 0.2 : 0.02) * rate) * F;
      F *= std::pow(F.determinant(), -0.3);
      const double before = history.equivalent_plastic_strain;
      const Mat3 tau = this->kirchhoff(F, history);
      EXPECT_LE(von_mises(tau) / this->yield(history), 1 + 1e-10);
      EXPECT_NEAR(history.plastic_metric.matrix().determinant(), 1, 1e-10);
      EXPECT_GE(history.equivalent_plastic_strain, before);
    }
    EXPECT_GT(history.equivalent_plastic_strain, 2);
  }
}

TYPED_TEST(VonMisesLaw, UnloadsElastically) {
  typename TestFixture::History history;
  const Mat3 loaded = uniaxial(this->yield(0.3), 0.3);
  const Mat3 tau_loaded = this->kirchhoff(loaded, history);
  const typename TestFixture::History held = history;
  // Axial logarithmic strain taken back by d relieves 2 mu of deviator and kappa of volume.
  const double d = 1e-3;
  const Mat3 tau = this->kirchhoff(diagonal(std::exp(-d), 1, 1) * loaded, history);
  EXPECT_NEAR((tau - tau_loaded)(0, 0), -d * this->law.linearised().pressure_wave_modulus(), 1e-9 * young);
  EXPECT_EQ(history.equivalent_plastic_strain, held.equivalent_plastic_strain);
  EXPECT_EQ(history.plastic_metric, held.plastic_metric);
}

TYPED_TEST(VonMisesLaw, StressOfTheStateItHasFlownToIsTheSameAgain) {
  typename TestFixture::History history;
  const Mat3 F = rotation(0.3) * shear(0.7);
  const Mat3 once = this->kirchhoff(F, history);
  const typename TestFixture::History held = history;
  for (int i = 0; i < 10; ++i)
    EXPECT_LT((this->kirchhoff(F, history) - once).norm() / once.norm(), 1e-12);
  EXPECT_NEAR(history.equivalent_plastic_strain, held.equivalent_plastic_strain, 1e-14);
  EXPECT_LT((history.plastic_metric.matrix() - held.plastic_metric.matrix()).norm(), 1e-13);
}

TYPED_TEST(VonMisesLaw, StressJoinsTheDerivativesOfItsEnergyAtFixedHistory) {
  typename TestFixture::History history;
  const Mat3 loaded = rotation(0.4) * uniaxial(this->yield(0.4), 0.4);
  this->kirchhoff(loaded, history);
  // Inside the yield surface; with the maps of F, and with an area and a volume map of their own.
  Strain strain = Strain::of(diagonal(1 - 1e-3, 1, 1) * loaded);
  for (const double own : {0.0, 0.01}) {
    strain.J *= 1 + own;
    strain.H *= 1 - own;
    typename TestFixture::History held = history;
    const Mat3 P = this->law.piola(strain, held);
    EXPECT_EQ(held.plastic_metric, history.plastic_metric);
    const auto energy = [&](const Mat3& F, double J) { return this->law.energy({F, strain.H, J}, history); };
    const double h = 1e-6;
    Mat3 difference = (energy(strain.F, strain.J + h) - energy(strain.F, strain.J - h)) / (2 * h) * strain.H;
    for (int i = 0; i < 9; ++i) {
      Mat3 plus = strain.F, minus = strain.F;
      plus.data()[i] += h;
      minus.data()[i] -= h;
      difference.data()[i] += (energy(plus, strain.J) - energy(minus, strain.J)) / (2 * h);
    }
    EXPECT_LT((P - difference).norm() / P.norm(), 1e-7);
  }
}

TYPED_TEST(VonMisesLaw, WorkPutInIsStoredOrSpentOnPlasticFlow) {
  typename TestFixture::History history;
  double work = 0;
  Mat3 F_old = Mat3::Identity(), P_old = Mat3::Zero();
  constexpr int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const double axial = 0.5 * i / steps;
    const Mat3 F = diagonal(std::exp(axial), std::exp(-0.4 * axial), std::exp(-0.5 * axial));
    const Mat3 P = this->law.piola(Strain::of(F), history);
    work += 0.5 * ((P + P_old).array() * (F - F_old).array()).sum();
    F_old = F;
    P_old = P;
  }
  const double accounted = this->law.energy(Strain::of(F_old), history) + this->law.plastic_work(history);
  EXPECT_NEAR(accounted / work, 1, 1e-5);
}
