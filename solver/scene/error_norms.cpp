#include "solver/scene/error_norms.hpp"

#include <cmath>

namespace tessera::solver {

ErrorNorms error_norms(const ExactSolution& exact, double time, const ParticleCloud& cloud,
                       std::span<const double> velocity, std::span<const double> pressure) {
  ErrorNorms norms;
  double velocity_scale = 0, pressure_scale = 0;
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    const Vec3& X = cloud.X[a];
    const double V = cloud.V[a];
    const Vec3 v(exact.velocity[0](X, time), exact.velocity[1](X, time), exact.velocity[2](X, time));
    const double of_v = (Vec3(velocity[3 * a], velocity[3 * a + 1], velocity[3 * a + 2]) - v).norm();
    const double p = exact.pressure(X, time), of_p = std::abs(pressure[a] - p);
    norms.l1_velocity += V * of_v;
    norms.l2_velocity += V * of_v * of_v;
    norms.l2_velocity_thesis += V * of_v * V * of_v;
    norms.l1_pressure += V * of_p;
    norms.l2_pressure += V * of_p * of_p;
    velocity_scale += V * v.squaredNorm();
    pressure_scale += V * p * p;
  }
  norms.l2_velocity = std::sqrt(norms.l2_velocity);
  norms.l2_velocity_thesis = std::sqrt(norms.l2_velocity_thesis);
  norms.l2_pressure = std::sqrt(norms.l2_pressure);
  norms.l2_velocity_relative = velocity_scale > 0 ? norms.l2_velocity / std::sqrt(velocity_scale) : 0;
  norms.l2_pressure_relative = pressure_scale > 0 ? norms.l2_pressure / std::sqrt(pressure_scale) : 0;
  return norms;
}

} // namespace tessera::solver
