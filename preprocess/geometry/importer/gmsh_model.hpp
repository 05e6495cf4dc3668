/// gmsh's current model in the words of Domain.
#pragma once

#include "preprocess/geometry/domain.hpp"
#include "preprocess/geometry/triangles.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace tessera::importer {

/// Triangles of the model's surfaces, with their nodes' coordinates.
preprocess::Triangles surface_triangles();

/// Vertices, positive tetrahedra and their boundary, with gmsh's tags beside them.
struct TaggedDomain {
  preprocess::Domain domain;
  std::unordered_map<std::size_t, std::int32_t> vertex_of_node;
  std::vector<int> surface_tags;           ///< gmsh tag of each of domain.surfaces
  std::map<int, std::int32_t> curve_index; ///< Domain curve of each gmsh curve that is a feature
};

/// Degrees: bodies that come without a CAD's surfaces are cut along sharper edges.
constexpr double crease = 40;

/// Node tags of all tetrahedra of a volume, four each.
std::vector<std::size_t> corners_of(int volume);

/// Reads the nodes and tetrahedra of a body, `corners` of these volumes; where surfaces of the model wall a
/// cavity off, those inside the cavity are left out (gmsh's constrained Delaunay fills it too). Facets get
/// the surface whose triangle they are; the surfaces are those that bound the body, in the order of their
/// tags, named face1, face2... by tag. `need_surfaces`: InputError when a facet has none (else its surface
/// stays -1).
TaggedDomain read_tetrahedra(const std::vector<int>& volumes, const std::vector<std::size_t>& corners,
                             const std::string& name, bool need_surfaces);

/// Throws InputError unless the tetrahedra fill the volume inside their surface to rounding.
void check_filled(preprocess::Domain& domain, double surface_volume, const std::string& name);

/// Curves of the feature edges from gmsh's line elements, numbered by tag.
void read_curves(TaggedDomain& tagged);

/// Physical groups of volumes, surfaces, curves and points. A group with nothing of this body in it is left
/// out where the file holds other bodies.
void read_groups(TaggedDomain& tagged, const std::vector<int>& volumes);

} // namespace tessera::importer
