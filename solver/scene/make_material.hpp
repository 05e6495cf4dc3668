/// The material of a scene: the only place where a law is chosen.
#pragma once

#include "solver/physics/material.hpp"
#include "solver/scene/scene.hpp"

#include <memory>

namespace tessera::solver {

/// Of a validated material, for that many particles.
template <int D>
std::unique_ptr<Material<D>> make_material(const MaterialSpec& spec, std::int64_t particles);

/// Its moduli at small strains.
ElasticConstants linearised(const MaterialSpec& spec);

} // namespace tessera::solver
