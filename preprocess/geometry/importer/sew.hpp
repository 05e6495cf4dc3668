/// Loose CAD surfaces made a solid.
#pragma once

#include "preprocess/geometry/importer/request.hpp"

namespace tessera::importer {

/// Where the model has surfaces but no solid: sews those whose edges coincide, within ever larger gaps up to
/// 1e-4 of the diagonal, until they close. Throws InputError with the number of free edges when they do not.
void sew_surfaces(const Request& request);

} // namespace tessera::importer
