/// A moment of a stored run as numbers: fields at its particles and, by the corrected kernel, anywhere in the
/// body.
#pragma once

#include "core/particle_cloud.hpp"
#include "io/field_series.hpp"
#include "io/frame_file.hpp"
#include "solver/operators/sampling.hpp"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tessera::post {

/// Where a point is meant: in the body as it was, or as it is at the moment.
enum class Configuration { reference, current };

struct Snapshot {
  std::filesystem::path file; ///< the frame's
  io::StoredFields frame;
  ParticleCloud cloud;
};

/// The last of the frames, the first, or the one nearest to a time in seconds. InputError where `which` is
/// none of these.
const io::StoredFrame& chosen_frame(const std::vector<io::StoredFrame>& frames, const std::string& which);

/// That frame of the run stored in `folder` with the folder's particles. InputError where either is missing
/// or damaged, or they do not belong together.
Snapshot read_snapshot(const std::filesystem::path& folder, const std::string& which = "last");

/// "PlasticStrain", "Velocity", or one component of an array: "Stress.xy". InputError listing the fields
/// there are where this is none of them, and where it is neither a number nor a vector.
io::StoredField field_of(const Snapshot& snapshot, const std::string& name);

/// What build_sampling gives at each of the points (m); empty where one lies outside the body. In the current
/// configuration distances are those before the local deformation, and linear fields of the current position
/// are exact.
std::vector<std::optional<solver::Sampling>> samplings(const Snapshot& snapshot, std::span<const Vec3> points,
                                                       Configuration configuration);

/// The same in the reference configuration.
std::vector<std::optional<solver::Sampling>> samplings(const ParticleCloud& cloud,
                                                       std::span<const Vec3> points);

/// The field there, one entry a component.
Eigen::VectorXd value_at(const io::StoredField& field, const solver::Sampling& point);

} // namespace tessera::post
