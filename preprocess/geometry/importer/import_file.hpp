/// The ways from a file to a Domain. All of it runs in the importer's own process.
#pragma once

#include "preprocess/geometry/domain.hpp"
#include "preprocess/geometry/importer/request.hpp"

namespace tessera::importer {

/// All return lengths in the units of the numbers (a slab's thickness is 1), and throw InputError for what is
/// wrong with the file.
preprocess::Domain import_cad(const Request& request);        ///< solids: CAD files and shapes
preprocess::Domain import_plane_cad(const Request& request);  ///< plane figures: CAD files and shapes
preprocess::Domain import_mesh(const Request& request);       ///< .msh with tetrahedra
preprocess::Domain import_plane_mesh(const Request& request); ///< .msh with triangles
preprocess::Domain import_surface(const Request& request);    ///< .stl, .obj, .ply

} // namespace tessera::importer
