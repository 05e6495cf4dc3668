/// The numbers a scene's probes follow.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/operators/sampling.hpp"
#include "solver/scene/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tessera::solver {

/// What a probe may look at: one entry a particle, three components in plane strain too.
struct ProbeFields {
  std::span<const Vec3> X;                        ///< m
  std::span<const double> displacement, velocity; ///< particles x 3, m and m/s
  std::span<const double> plastic_strain, von_mises, pressure, J;
};

/// The same at one particle or point.
struct ProbeState {
  Vec3 X, displacement, velocity;
  double plastic_strain, von_mises, pressure, J;
};

/// Names a scene may use, for messages.
const std::vector<std::string>& probe_quantities();
const std::vector<std::string>& probe_reductions();

/// Column name of a probe: its name and the unit of its quantity ("radius_m").
std::string column_name(const Probe& probe);

/// A probe bound to its particles. It remembers how far each has turned: read it in the order of time, more
/// often than every half turn.
class ProbeReader {
 public:
  /// InputError when the cloud has no such set, or its point lies outside the cloud.
  ProbeReader(const Probe& probe, const ParticleCloud& cloud);
  double read(const ProbeFields& fields);

 private:
  /// Of the i-th place, in the state it is in.
  double value(std::size_t i, const ProbeState& state);

  std::size_t quantity_;
  std::string reduce_;
  Vec3 centre_;
  std::vector<std::int32_t> particles_; ///< of the set
  std::optional<Sampling> point_;       ///< or a point between particles
  std::vector<double> turned_;          ///< angle of each at the last reading, degrees
};

} // namespace tessera::solver
