/// body.vtu: the shape of the undeformed body on disk, readable by ParaView.
#pragma once

#include "core/body_mesh.hpp"

#include <filesystem>

namespace tessera::io {

/// Tetrahedra, triangles and lines of one unstructured grid, with its `dimension` as field data; double
/// precision. Written atomically; RunError when the disk refuses.
void write_body(const BodyMesh& mesh, const std::filesystem::path& file);

/// InputError when the file is missing, truncated, altered or no such grid.
BodyMesh read_body(const std::filesystem::path& file);

} // namespace tessera::io
