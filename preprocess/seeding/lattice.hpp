/// Simple cubic lattice of a body.
#pragma once

#include "preprocess/voronoi/cad_topology.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Points within this fraction of the spacing of the boundary count as on it, inside or out.
inline constexpr double lattice_band = 0.02;

/// In the plane, cubic means square, hexagonal means triangular rows; body-centred is for bodies only.
/// Hexagonal in space is the close packing of layers ABAB.
enum class LatticeKind { cubic, body_centred, hexagonal };

struct Lattice {
  Vec3 origin = Vec3::Zero();           ///< m
  double spacing = 0;                   ///< m
  std::array<std::int32_t, 3> counts{}; ///< points along each axis of the bounding box
  std::vector<std::array<std::int32_t, 3>> index;
  std::vector<CadPlace> place; ///< by nearness to the CAD entities, within the band

  Vec3 position(std::size_t i) const {
    return origin + spacing * Vec3(index[i][0], index[i][1], index[i][2]);
  }
};

/// Where the lattice of a bounding box lies: as many whole spacings as fit along each axis, centred, so that
/// a box whose sides are multiples of the spacing has points on all its faces.
Lattice lattice_frame(const Domain& domain, double spacing);

/// The lattice points inside the body or within the band of its boundary.
///
/// Columns along z: where a column crosses the boundary triangles is decided by exact orientations with
/// consistent tie breaking, so it crosses a closed surface an even number of times. Around facets that
/// approximate a curved face the band is at least their chordal error (capped at a quarter of the spacing).
Lattice lattice_points(const Domain& domain, const CadTopology& cad, double spacing);

/// How many points lattice_points would give.
std::int64_t lattice_count(const Domain& domain, const CadTopology& cad, double spacing);

/// The spacing whose lattice has `count` points within 2 %, or as near as the body's symmetry allows;
/// spacings that divide a side of the bounding box are preferred.
double lattice_spacing_for(const Domain& domain, const CadTopology& cad, std::int64_t count);

} // namespace tessera::preprocess
