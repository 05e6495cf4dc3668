/// What of a Domain is worth keeping for pictures.
#pragma once

#include "core/body_mesh.hpp"
#include "preprocess/geometry/domain.hpp"

namespace tessera::preprocess {

/// Tetrahedra, boundary and feature edges; of a slab its upper lid, at z = 0, with the rim.
BodyMesh body_mesh(const Domain& domain);

} // namespace tessera::preprocess
