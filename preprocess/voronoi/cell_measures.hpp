/// Volume, first moment and boundary area of every restricted Voronoi cell.
#pragma once

#include "core/cell_mesh.hpp"
#include "preprocess/voronoi/restricted_voronoi.hpp"

#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// A cell's outward area on one CAD surface.
struct SurfaceShare {
  std::int32_t surface;
  Vec3 area;
};

/// In the body's scaled coordinates. In a slab volumes are areas, shares lie on walls only, and moments and
/// shares have no z.
struct CellMeasures {
  std::vector<double> volume;
  std::vector<Vec3> moment;                      ///< integral of (x - seed)
  std::vector<std::vector<SurfaceShare>> shares; ///< by cell; surfaces ascending; empty inside
  double closure_error = 0;      ///< largest |sum of face areas| / sum of |face areas| of a cell
  std::int64_t disconnected = 0; ///< cells that fall into several pieces

  /// A part of a cell that does not hang together with its seed (material across a slot) and who got it: the
  /// one across its largest contact among the neighbours that own what they show there, or, where it touches
  /// only other orphans, who got those. Nobody (then `receiver` is `cell`) where a whole piece of the body
  /// has no seed.
  struct Orphan {
    std::int32_t cell, component, receiver;
    double volume;
    Vec3 centroid;
    Vec3 inside; ///< a point within the part, its centroid where that lies within: room for a particle
  };
  std::vector<Orphan> orphans; ///< ascending in cell, component; slivers of rounding are none
  double stranded = 0;         ///< volume of the orphans nobody could take: left with a seed across the gap
};

/// Orphan parts are counted with their receiver: volumes sum to the body's.
CellMeasures measure_cells(const RestrictedVoronoi& voronoi);

/// The cells as polyhedra in metres, for looking at; a slab's as flat polygons (one face) at z = 0.
CellMesh collect_cells(const RestrictedVoronoi& voronoi, const CellMeasures& measures);

} // namespace tessera::preprocess
