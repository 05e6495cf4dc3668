/// The numbers a scene's probes follow.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/scene/scene.hpp"

#include <span>
#include <string>
#include <vector>

namespace tessera::solver {

/// What a probe may look at: one entry a particle, three components in plane strain too.
struct ProbeFields {
  std::span<const Vec3> X;                        ///< m
  std::span<const double> displacement, velocity; ///< particles x 3, m and m/s
  std::span<const double> plastic_strain, von_mises, pressure;
};

/// Names a scene may use, for messages.
const std::vector<std::string>& probe_quantities();
const std::vector<std::string>& probe_reductions();

/// Column name of a probe: its name and the unit of its quantity ("radius_m").
std::string column_name(const Probe& probe);

/// A probe bound to its particles.
class ProbeReader {
 public:
  /// InputError when the cloud has no such set.
  ProbeReader(const Probe& probe, const ParticleCloud& cloud);
  double read(const ProbeFields& fields) const;

 private:
  std::size_t quantity_;
  std::string reduce_;
  std::vector<std::int32_t> particles_;
};

} // namespace tessera::solver
