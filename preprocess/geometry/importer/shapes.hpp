/// The built-in shapes, drawn by OpenCASCADE.
#pragma once

#include "preprocess/geometry/domain.hpp"
#include "preprocess/geometry/import.hpp"

#include <vector>

namespace tessera::importer {

/// Draws a shape of preprocess::known_shapes(), already checked, as gmsh's model.
void draw_shape(const preprocess::ShapeSpec& shape, int dimension);

/// Names the drawn shape's surfaces (curves, in the plane), given by their tags, after ShapeKind::surfaces.
std::vector<std::string> shape_names(const preprocess::ShapeSpec& shape, int dimension,
                                     const std::vector<int>& tags);

} // namespace tessera::importer
