/// The boundary of a set of tetrahedra.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Faces of a positive tetrahedron (local vertex numbers), each counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 3>, 4> tet_faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Faces that belong to one tetrahedron only, outward for positive tetrahedra, in the order of the
/// tetrahedra; `surface` is left at -1.
std::vector<Domain::Facet> boundary_of(const std::vector<std::array<std::int32_t, 4>>& tets);

} // namespace tessera::preprocess
