#include "solver/scene/error_norms.hpp"

#include <cmath>

namespace tessera::solver {
namespace {

struct Sums {
  double l1 = 0, l2 = 0; ///< of the error
  double l2_thesis = 0;  ///< with each |e| multiplied by V before it is squared
  double scale = 0;      ///< of the exact field
  double relative() const { return scale > 0 ? l2 / scale : 0; }
};

/// Sums over the particles of a field of as many components as there are formulas.
Sums sums(std::span<const Expression> exact, double time, const ParticleCloud& cloud,
          std::span<const double> values) {
  Sums s;
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    double error = 0, size = 0;
    for (std::size_t c = 0; c < exact.size(); ++c) {
      const double value = exact[c](cloud.X[a], time);
      error += std::pow(values[exact.size() * a + c] - value, 2);
      size += value * value;
    }
    const double V = cloud.V[a];
    s.l1 += V * std::sqrt(error);
    s.l2 += V * error;
    s.l2_thesis += V * V * error;
    s.scale += V * size;
  }
  s.l2 = std::sqrt(s.l2);
  s.l2_thesis = std::sqrt(s.l2_thesis);
  s.scale = std::sqrt(s.scale);
  return s;
}

} // namespace

ErrorNorms error_norms(const ExactSolution& exact, double time, const ParticleCloud& cloud,
                       const FinalFields& fields) {
  ErrorNorms norms;
  if (exact.displacement) {
    const Sums s = sums(*exact.displacement, time, cloud, fields.displacement);
    norms.l1_displacement = s.l1;
    norms.l2_displacement = s.l2;
    norms.l2_displacement_relative = s.relative();
  }
  if (exact.velocity) {
    const Sums s = sums(*exact.velocity, time, cloud, fields.velocity);
    norms.l1_velocity = s.l1;
    norms.l2_velocity = s.l2;
    norms.l2_velocity_thesis = s.l2_thesis;
    norms.l2_velocity_relative = s.relative();
  }
  if (exact.pressure) {
    const Sums s = sums({&*exact.pressure, 1}, time, cloud, fields.pressure);
    norms.l1_pressure = s.l1;
    norms.l2_pressure = s.l2;
    norms.l2_pressure_relative = s.relative();
  }
  return norms;
}

} // namespace tessera::solver
