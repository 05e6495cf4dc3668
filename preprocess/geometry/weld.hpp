/// Points that mean the same vertex.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::preprocess {

/// For each point the index of the first point within `tolerance` that stands for itself: that of the vertex
/// it is. Files of bare triangles repeat their corners, rounded each time anew.
std::vector<std::int32_t> weld(std::span<const Vec3> points, double tolerance);

} // namespace tessera::preprocess
