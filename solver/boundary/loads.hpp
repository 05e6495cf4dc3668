/// Forces from outside: tractions, pressures that follow the surface, body forces.
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/boundary/given_vector.hpp"
#include "solver/physics/strain.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::solver {

/// What a load may depend on.
template <int D>
struct Loaded {
  std::span<const Vec3> X;   ///< reference positions, m
  std::span<const double> V; ///< subvolumes, m^3
  double density;            ///< kg/m^3
  StrainFields<D> strains;
  double time; ///< s
};

template <int D>
class Load {
 public:
  virtual ~Load() = default;
  /// Adds to the force per reference volume, N/m^3.
  virtual void add(const Loaded<D>& body, std::span<Vec<D>> force) const = 0;

 protected:
  /// Calls use(i, value) for the i-th of `particles`.
  template <class Use>
  static void each(const GivenVector& given, std::span<const std::int32_t> particles, const Loaded<D>& body,
                   Use&& use) {
    const Vec3 uniform = given.uniform ? given.value(Vec3::Zero(), body.time) : Vec3::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i)
      use(i, given.uniform ? uniform : given.value(body.X[particles[i]], body.time));
  }
};

/// Dead traction (Pa, per reference area) on a surface: its area times t / V, the boundary term of (3.82).
template <int D>
class Traction final : public Load<D> {
 public:
  /// `area`: what each particle owns of the surface, m^2.
  Traction(std::vector<std::int32_t> particles, std::vector<double> area, GivenVector traction)
      : particles_(std::move(particles)), area_(std::move(area)), traction_(std::move(traction)) {}

  void add(const Loaded<D>& body, std::span<Vec<D>> force) const override {
    this->each(traction_, particles_, body, [&](std::size_t i, const Vec3& t) {
      force[particles_[i]] += area_[i] / body.V[particles_[i]] * t.template head<D>();
    });
  }

 private:
  std::vector<std::int32_t> particles_;
  std::vector<double> area_;
  GivenVector traction_;
};

/// Pressure (Pa, positive pushes) on the surface as it deforms: by Nanson's formula -p H A / V.
template <int D>
class FollowingPressure final : public Load<D> {
 public:
  /// `area`: outward area vectors of the surface in the reference configuration, m^2. The pressure is the
  /// first component of `pressure`.
  FollowingPressure(std::vector<std::int32_t> particles, std::vector<Vec3> area, GivenVector pressure)
      : particles_(std::move(particles)), area_(std::move(area)), pressure_(std::move(pressure)) {}

  void add(const Loaded<D>& body, std::span<Vec<D>> force) const override {
    this->each(pressure_, particles_, body, [&](std::size_t i, const Vec3& p) {
      const std::int32_t a = particles_[i];
      const Vec3 pushed = body.strains[a].H * area_[i];
      force[a] -= p[0] / body.V[a] * pushed.template head<D>();
    });
  }

 private:
  std::vector<std::int32_t> particles_;
  std::vector<Vec3> area_;
  GivenVector pressure_;
};

/// Acceleration (m/s^2) of the mass: gravity, or an accelerated frame.
template <int D>
class BodyForce final : public Load<D> {
 public:
  BodyForce(std::vector<std::int32_t> particles, GivenVector acceleration)
      : particles_(std::move(particles)), acceleration_(std::move(acceleration)) {}

  void add(const Loaded<D>& body, std::span<Vec<D>> force) const override {
    this->each(acceleration_, particles_, body, [&](std::size_t i, const Vec3& b) {
      force[particles_[i]] += body.density * b.template head<D>();
    });
  }

 private:
  std::vector<std::int32_t> particles_;
  GivenVector acceleration_;
};

} // namespace tessera::solver
