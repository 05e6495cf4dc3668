/// Surface meshes as fine as the tolerance asks.
#pragma once

#include "preprocess/geometry/importer/gmsh_session.hpp"
#include "preprocess/geometry/importer/request.hpp"

#include <functional>
#include <optional>

namespace tessera::importer {

struct Tessellation {
  double mesh_measure, cad_measure; ///< volume or area
  Sizes sizes;                      ///< that led to it
};

/// Meshes curves and surfaces ever finer until what `measure` finds on the mesh is within the tolerance of
/// `exact`, or of its own limit where the CAD kernel knows none. `size` is the longest edge. Throws
/// InputError when they cannot be meshed, take too many triangles, or stay off.
Tessellation tessellate(std::optional<double> exact, double size, const FileSizes& file,
                        const Request& request, const std::function<double()>& measure);

} // namespace tessera::importer
