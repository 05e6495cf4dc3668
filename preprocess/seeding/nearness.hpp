/// Distances of a point from segments and triangles.
#pragma once

#include "core/tensor.hpp"

#include <array>

namespace tessera::preprocess {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);
Vec3 nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& X);

inline double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  return (p - nearest_on_segment(p, a, b)).squaredNorm();
}

} // namespace tessera::preprocess
