/// Rigid tools around a body in a panel.
#pragma once

#include "postprocess/render/view.hpp"
#include "postprocess/tool.hpp"

#include <array>
#include <vector>

namespace tessera::post {

struct ToolShapes {
  std::vector<std::array<Vec3, 2>> lines;  ///< their surfaces seen edge-on, far longer than the picture
  std::vector<std::array<Vec3, 4>> bands;  ///< along those lines on the tools' side
  std::vector<std::array<Vec3, 4>> floors; ///< planes seen from the body's side, as large as its footprint
};

/// At `time` (s). `around`: the places of the body, m; `band`: how wide bands are, m. Planes between viewer
/// and body are left out.
ToolShapes tool_shapes(const std::vector<Tool>& tools, double time, const View& view,
                       const Eigen::AlignedBox3f& around, double band);

} // namespace tessera::post
