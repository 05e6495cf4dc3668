/// CAD in gmsh: where it comes from, and what its points and curves tell of corners.
#pragma once

#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/importer/request.hpp"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace tessera::importer {

/// Opens the file, or draws the shape, as gmsh's model.
void open_cad(const Request& request);

/// Diagonal of the bounding box of these entities; InputError when there is none.
double diagonal_of(int dimension, const std::vector<int>& tags, const std::string& name);

/// Corners may be at CAD points only, and kinks are those of the CAD's curves: the mesh's own edges turn
/// wherever a curve does.
preprocess::CornerRule corner_rule(const std::vector<int>& curves,
                                   const std::unordered_map<std::size_t, std::int32_t>& vertex_of_node);

/// The one node on a CAD point, as a vertex of the body.
std::optional<std::int32_t>
vertex_of_point(int point, const std::unordered_map<std::size_t, std::int32_t>& vertex_of_node);

} // namespace tessera::importer
