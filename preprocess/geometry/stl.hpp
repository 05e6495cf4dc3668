/// Stereolithography files: bare triangles, text or binary.
#pragma once

#include "preprocess/geometry/triangles.hpp"

#include <string>
#include <string_view>

namespace tessera::preprocess {

/// Reads an STL file's bytes; corners closer than 1e-7 of the bounding box's diagonal become one vertex,
/// triangles that lose a corner by it are dropped. Lengths as in the file. Throws InputError naming `origin`
/// when it is neither text nor binary STL, cut off, or has a coordinate that is not a number.
Triangles read_stl(std::string_view bytes, const std::string& origin);

/// Throws InputError unless the surface is closed and can be oriented: how many open edges, and where the
/// first is. Leaves the triangles of every shell facing outwards (cavities: into the cavity).
void close_and_orient(Triangles& surface, const std::string& origin);

} // namespace tessera::preprocess
