/// Surfaces that touch, joined to one figure.
#pragma once

#include <vector>

namespace tessera::importer {

/// The model's surfaces in sets that hang together by common curves, each ascending, by their first.
std::vector<std::vector<int>> connected_surfaces();

/// Makes surfaces share the curves along which they touch or overlap; physical groups follow. Surfaces of
/// gmsh's own kernel are joined where their curves coincide.
void glue_surfaces();

} // namespace tessera::importer
