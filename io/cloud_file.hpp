/// cloud.vtp: a ParticleCloud on disk, readable by ParaView; and the Voronoi cells.
#pragma once

#include "core/cell_mesh.hpp"
#include "core/particle_cloud.hpp"

#include <filesystem>

namespace tessera::io {

/// Points with arrays volume, area (3), centroid (3), cad_dimension, id, one mask "set:NAME" a set and
/// "area:NAME" (3) where the set has surface; field data dimension, spacing, seed, domain_volume,
/// arrangement, subvolumes, format_version. Double precision, LZ4. Written atomically; RunError when the disk
/// refuses.
void write_cloud(const ParticleCloud& cloud, const std::filesystem::path& file);

/// InputError when the file is missing, truncated, altered (its checksum disagrees), not a cloud or of
/// another format version.
ParticleCloud read_cloud(const std::filesystem::path& file);

/// cells.vtu: polyhedra with arrays particle and volume.
void write_cells(const CellMesh& cells, const ParticleCloud& cloud, const std::filesystem::path& file);

} // namespace tessera::io
