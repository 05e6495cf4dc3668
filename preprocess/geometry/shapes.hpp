/// The built-in shapes: which there are, and which lengths make sense. Drawn by importer/shapes.cpp.
#pragma once

#include "preprocess/geometry/import.hpp"

namespace tessera::preprocess {

/// The known shape of that name and dimension; InputError listing them when there is none.
const ShapeKind& shape_kind(const std::string& name, int dimension);

/// Throws InputError naming the length that makes no sense: missing, not positive, or not fitting the others.
void check_shape(const ShapeSpec& shape, int dimension);

} // namespace tessera::preprocess
