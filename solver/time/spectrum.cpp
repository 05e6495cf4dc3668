#include "solver/time/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

double asymmetry(const MatrixXd& A) {
  return (A - A.transpose()).cwiseAbs().maxCoeff();
}

/// Up to what differences of the law leave.
bool symmetric(const Linearised& body) {
  constexpr double round_off = 1e-7;
  const double scale = std::max(body.K.cwiseAbs().maxCoeff(), body.C.cwiseAbs().maxCoeff());
  return body.B.size() == 0 && asymmetry(body.K) <= round_off * scale &&
         asymmetry(body.C) <= round_off * scale;
}

/// (u, J, J with its dissipation a step ago, v half a step ago) to the next step, dt in units of the body's.
MatrixXd verlet_step(const Linearised& body, double dt) {
  const Index n = body.K.rows(), m = body.D.rows();
  const Index u = 0, J = n, damped = n + m, v = n + 2 * m, size = 2 * n + 2 * m;
  const auto unit = [&](Index at, Index rows) {
    MatrixXd block = MatrixXd::Zero(rows, size);
    block.middleCols(at, rows).setIdentity();
    return block;
  };
  const MatrixXd u_n = unit(u, n), v_n = unit(v, n);
  MatrixXd v_next = v_n - dt * body.C * v_n - dt * body.K * u_n;
  if (m > 0)
    v_next += dt * body.B * unit(J, m);
  MatrixXd step(size, size);
  step.middleRows(u, n) = u_n + dt * v_next;
  step.middleRows(v, n) = v_next;
  if (m > 0) {
    const MatrixXd J_damped = unit(J, m) + dt * body.D * unit(damped, m);
    const MatrixXd strained = body.G * (u_n + 0.5 * dt * v_next); // by F half way through the step
    step.middleRows(J, m) =
        J_damped + dt * (body.G * v_next + body.pull.asDiagonal() * (strained - J_damped));
    step.middleRows(damped, m) = J_damped;
  }
  return step;
}

/// Of a step's growth where the operators themselves grow by `own` in it: the method's error of that.
double tolerated(double own) {
  return 1.1 * own + tolerated_growth;
}

double spectral_radius(const MatrixXd& A) {
  return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues().cwiseAbs().maxCoeff();
}

/// Where the largest eigenvalue of dt^2 K + 2 dt C is 4: Rayleigh's quotient of its field asks for a larger
/// step than the true one, which the next field corrects.
double symmetric_limit(const Linearised& body) {
  double dt = 1;
  for (int i = 0; i < 50; ++i) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(dt * dt * body.K + 2 * dt * body.C);
    const Eigen::VectorXd q = modes.eigenvectors().rightCols<1>();
    const double K = std::max(q.dot(body.K * q), 0.0), C = std::max(q.dot(body.C * q), 0.0);
    const double next = 4 / (C + std::sqrt(C * C + 4 * K));
    if (std::abs(next - dt) < 1e-9 * dt)
      return next;
    dt = next;
  }
  return dt;
}

/// By bisection on the spectral radius of the step itself; growth over the body's unit of time.
double limit_by_steps(const Linearised& body, double growth) {
  const auto bears = [&](double dt) {
    return std::log(spectral_radius(verlet_step(body, dt))) <= tolerated(growth * dt);
  };
  // What the symmetric parts bear is a first guess.
  Linearised even{0.5 * (body.K + body.K.transpose()), 0.5 * (body.C + body.C.transpose()), {}, {}, {}, {}};
  if (body.B.size() > 0)
    even.K -= 0.5 * (body.B * body.G + (body.B * body.G).transpose()); // J as F has it
  double stable = 0, unstable = 1.05 * symmetric_limit(even);
  while (bears(unstable)) {
    stable = unstable;
    unstable *= 1.2;
  }
  constexpr double precision = 1e-3, hopeless = 1e-2;
  const double guess = unstable;
  while (unstable - stable > precision * unstable && unstable > hopeless * guess) {
    const double middle = stable == 0 ? 0.85 * unstable : 0.5 * (stable + unstable);
    (bears(middle) ? stable : unstable) = middle;
  }
  return stable;
}

/// Of d/dt (u, v) or (u, v, J), 1/s, sorted.
std::vector<Complex> eigenvalues(const Linearised& body) {
  const Index n = body.K.rows(), m = body.D.rows();
  MatrixXd A = MatrixXd::Zero(2 * n + m, 2 * n + m); // u, v, J
  A.block(0, n, n, n).setIdentity();
  A.block(n, 0, n, n) = -body.K;
  A.block(n, n, n, n) = -body.C;
  if (m > 0) {
    A.block(n, 2 * n, n, m) = body.B;
    A.block(2 * n, 0, m, n) = body.pull.asDiagonal() * body.G;
    A.block(2 * n, n, m, n) = body.G;
    A.block(2 * n, 2 * n, m, m) = body.D;
    A.block(2 * n, 2 * n, m, m).diagonal() -= body.pull;
  }
  const Eigen::VectorXcd found = Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues();
  std::vector<Complex> values;
  for (const Complex& lambda : found)
    values.push_back(lambda / body.time);
  if (body.evolves_H)
    for (const double pull : body.pull)
      values.emplace_back(-pull / body.time);
  std::sort(values.begin(), values.end(), [](const Complex& p, const Complex& q) {
    return p.real() != q.real() ? p.real() < q.real() : p.imag() < q.imag();
  });
  return values;
}

/// Up to which no eigenvalue is amplified by more than it may where the fastest grows at the rate `growth`;
/// infinite where none ever is.
double largest_heun_step(const std::vector<Complex>& eigenvalues, double growth) {
  double largest = std::numeric_limits<double>::infinity();
  for (const Complex& lambda : eigenvalues) {
    const auto bears = [&](double dt) {
      return 0.5 * std::log1p(heun_growth(lambda * dt)) <= tolerated(growth * dt);
    };
    // The region |z| <= 1 of lambda dt lies within |lambda dt| <= 2; a growing mode's is little wider.
    const double farthest = 2.5 / std::abs(lambda);
    if (!std::isfinite(farthest))
      continue;
    constexpr int looks = 250;
    double stable = 0, unstable = 0;
    for (int i = 1; i <= looks && stable < largest; ++i) {
      unstable = farthest * i / looks;
      if (!bears(unstable))
        break;
      stable = unstable;
    }
    if (stable >= std::min(largest, farthest))
      continue;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (stable + unstable);
      (bears(middle) ? stable : unstable) = middle;
    }
    largest = std::min(largest, stable);
  }
  return largest;
}

/// The same of Verlet's method.
double largest_verlet_step(const Linearised& body, double growth) {
  double dt = symmetric(body) ? symmetric_limit(body) : limit_by_steps(body, body.time * growth);
  if (body.evolves_H) // (1 - pull dt / 2)^2 a step
    dt = std::min(dt, 4 / body.pull.maxCoeff());
  return body.time * dt;
}

} // namespace

Spectrum spectrum_of(const Linearised& body, const std::string& integrator) {
  Spectrum spectrum;
  spectrum.eigenvalues = eigenvalues(body);
  for (const Complex& lambda : spectrum.eigenvalues)
    spectrum.growth_rate = std::max(spectrum.growth_rate, lambda.real());
  constexpr double round_off = 1e-6; // of zero eigenvalues that share an eigenvector
  spectrum.grows = body.time * spectrum.growth_rate > round_off;
  const double growth = spectrum.grows ? spectrum.growth_rate : 0;
  if (integrator == "heun")
    spectrum.largest_step = largest_heun_step(spectrum.eigenvalues, growth);
  else if (symmetric(body) || 2 * (body.K.rows() + body.D.rows()) <= largest_step_matrix)
    spectrum.largest_step = largest_verlet_step(body, growth);
  return spectrum;
}

double verlet_amplification(const Linearised& body, double dt) {
  return spectral_radius(verlet_step(body, dt / body.time));
}

} // namespace tessera::solver
