/// A body as the tessellator sees it: tetrahedra, tagged boundary triangles, and the CAD's own edges and
/// corners.
///
/// A plane body (dimension 2, plane strain) is a slab of unit thickness, z from -1/2 to 1/2 m: its triangles
/// drawn out to prisms of three tetrahedra each. Its surfaces are the walls over the CAD's curves; the facets
/// of its two lids carry the surface `lid`. Feature edges are the rim of the upper lid (curve = index of the
/// wall below), corners are vertices of that rim. So volumes are areas, areas are lengths of boundary, and
/// one tessellator does both.
#pragma once

#include "core/tensor.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::preprocess {

/// SI units (m). Indices refer to `vertices`.
struct Domain {
  static constexpr std::int32_t lid = -1;

  /// Boundary triangle, counter-clockwise seen from outside.
  struct Facet {
    std::array<std::int32_t, 3> vertices;
    std::int32_t surface; ///< CAD surface it lies on, index into `surfaces`; `lid` on the lids of a slab
    std::int32_t tet;     ///< the tetrahedron behind it
  };
  /// Piece of a CAD curve where two surfaces meet (a seam of one smooth surface is not a feature).
  struct FeatureEdge {
    std::array<std::int32_t, 2> vertices;
    std::int32_t curve; ///< CAD curve it lies on
  };
  /// Named by the CAD or mesh file: a physical group, or a CAD face's own name.
  struct Group {
    std::string name;
    /// Of its entities: 0 points, 1 curves, 2 surfaces, 3 the whole body. A slab's: 0 points of the upper
    /// rim, 2 walls, 3 the whole body.
    int dimension = 2;
    std::vector<std::int32_t> surfaces; ///< for dimension 2: indices into `surfaces`
    std::vector<std::int32_t> curves;   ///< for dimension 1
    std::vector<std::int32_t> vertices; ///< for dimension 0
  };

  int dimension = 3; ///< 2: a slab
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 4>> tets; ///< all of positive volume
  std::vector<Facet> facets;
  std::vector<FeatureEdge> feature_edges;
  std::vector<std::int32_t> corners; ///< vertices that are CAD corners (end of feature curves)
  std::vector<std::string> surfaces; ///< names of the CAD surfaces ("face1" where the file names none)
  std::vector<Group> groups;

  double volume = 0;     ///< sum of the tetrahedra, m^3 (a slab's: the area of the plane body, m^2)
  double cad_volume = 0; ///< what the CAD kernel says, m^3 or m^2; equals `volume` for mesh input
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero(); ///< bounding box of the vertices; z = 0 for a slab

  double tet_volume(std::size_t t) const;

  /// Fills volume, lower and upper from vertices and tets.
  void measure();

  /// Throws InputError naming `origin` unless tets are positive, every facet has its tetrahedron, and the
  /// facets close: each edge of the boundary is shared by an even number of facets and their area vectors sum
  /// to zero.
  void validate(const std::string& origin) const;
};

} // namespace tessera::preprocess
