/// Triangle surfaces of STL, OBJ and PLY files: read, repaired where that is trivial, and otherwise refused
/// with what is wrong, how often and where. The work is CGAL's.
#pragma once

#include "preprocess/geometry/importer/request.hpp"
#include "preprocess/geometry/triangles.hpp"

namespace tessera::importer {

/// Triangles of the file. Corners closer than 1e-7 of the bounding box's diagonal are one vertex; what loses
/// a corner by it, or is there twice, is dropped; polygons are triangulated. Throws InputError when the file
/// cannot be read, names vertices that are not there, or has a coordinate that is not a number.
preprocess::Triangles read_surface(const Request& request);

/// The shells of the solid that is meant, facing out of it. Throws InputError: edges with more than two
/// triangles, only one side, holes of more than Request::close_holes edges, vertices in which the surface
/// touches itself, self-intersections, several solids and none chosen. Notes the holes it closes.
preprocess::Triangles closed_surface(const preprocess::Triangles& surface, const Request& request);

} // namespace tessera::importer
