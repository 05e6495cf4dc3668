/// A body's mesh made as fine as its particles.
#pragma once

#include "core/body_mesh.hpp"

namespace tessera::post {

/// Halves every edge longer than `longest` (m), again and again, the longest of each simplex first:
/// neighbours are split alike, whatever order they come in, so that nothing gapes. The first points are those
/// of `mesh`.
BodyMesh refined(const BodyMesh& mesh, double longest);

} // namespace tessera::post
