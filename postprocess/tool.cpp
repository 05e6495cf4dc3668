#include "postprocess/tool.hpp"

#include "solver/boundary/plane.hpp"
#include "solver/boundary/polyline.hpp"

namespace tessera::post {

std::vector<Tool> tools_of(const std::vector<solver::WallSpec>& walls, double reach) {
  std::vector<Tool> tools;
  for (const solver::WallSpec& wall : walls) {
    Tool tool;
    tool.velocity = wall.velocity;
    if (const auto* plane = dynamic_cast<const solver::Plane*>(wall.shape.get())) {
      tool.normal = plane->normal();
      tool.point = -plane->gap(Vec3::Zero()).distance * plane->normal();
    } else if (const auto* line = dynamic_cast<const solver::Polyline*>(wall.shape.get())) {
      for (const Vec<2>& x : line->drawn(reach))
        tool.line.emplace_back(x[0], x[1], 0);
    } else {
      continue;
    }
    tools.push_back(std::move(tool));
  }
  return tools;
}

} // namespace tessera::post
