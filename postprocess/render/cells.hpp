/// cells.vtu as polyhedra again.
#pragma once

#include "core/cell_mesh.hpp"

#include <string>

namespace tessera::post {

/// InputError when the file is damaged or holds no cells with their particles.
CellMesh read_cells(const std::string& file);

} // namespace tessera::post
