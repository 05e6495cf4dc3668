/// A body as one smooth piece: its mesh, moved and coloured by what its particles say.
#pragma once

#include "core/body_mesh.hpp"
#include "core/particle_cloud.hpp"
#include "io/frame_file.hpp"
#include "solver/operators/sampling.hpp"

#include <span>
#include <vector>

namespace tessera::post {

/// The undeformed body as fine as its particles, with the corrected kernel's weights at every point: linear
/// fields come out exactly, others smoothed over some two spacings.
struct Skin {
  BodyMesh mesh;
  std::vector<solver::Sampling> at; ///< one a point; where no particles surround it the nearest alone
};

/// `inside`: with the tetrahedra, for cuts; of large bodies these are coarser than the particles.
Skin skin_of(const BodyMesh& mesh, const ParticleCloud& cloud, bool inside);

/// Where the points are while the particles have these displacements (m).
std::vector<Vec3> moved(const Skin& skin, std::span<const Vec3> displacement);

/// A number at each point, from one a particle; NaN where one of those is NaN.
std::vector<double> values_on(const Skin& skin, std::span<const double> values);

} // namespace tessera::post
