/// Rigid tools as pictures show them.
#pragma once

#include "core/tensor.hpp"
#include "solver/scene/scene.hpp"

#include <vector>

namespace tessera::post {

/// A plane, or in the plane of the body a line, with the free side on its left.
struct Tool {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ(); ///< of a plane, pointing to the free side
  std::vector<Vec3> line;                            ///< none: a plane; m
  Vec3 velocity = Vec3::Zero();                      ///< m/s
};

/// The walls that are planes or lines, where they are at time zero, lines prolonged by `reach` (m) at both
/// ends.
std::vector<Tool> tools_of(const std::vector<solver::WallSpec>& walls, double reach);

} // namespace tessera::post
