/// What one panel shows: a body at a moment, with the lines around it.
#pragma once

#include "core/body_mesh.hpp"
#include "postprocess/cell_surfaces.hpp"
#include "postprocess/cut_body.hpp"
#include "postprocess/render/body.hpp"
#include "postprocess/render/colour_range.hpp"
#include "postprocess/render/tools.hpp"
#include "postprocess/render/view.hpp"
#include "postprocess/render_job.hpp"
#include "postprocess/skin.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkRenderer;

namespace tessera::post {

/// Files that several panels share, each read once, and the skins made of them.
class Shapes {
 public:
  const BodyMesh& body(const std::string& file);
  /// Of panel.body filled with the particles of panel.cloud; with its inside where the panel is cut.
  const Skin& skin(const Panel& panel);

 private:
  std::map<std::string, BodyMesh> bodies_;
  std::map<std::array<std::string, 3>, Skin> skins_;
};

struct Scene {
  Panel panel;
  Body body;                                ///< what is left of it by the cut
  CellSurfaces cells;                       ///< none: particles or skin are drawn
  std::optional<CutBody> skin;              ///< absent: particles or cells are drawn
  std::vector<std::array<Vec3, 2>> outline; ///< of the undeformed body
  ToolShapes tools;
  std::string second_line;    ///< of the caption
  Eigen::AlignedBox3f extent; ///< in the view
};

/// `cells` are those of panel.cells.
Scene scene_of(const Drawing& drawing, const Panel& panel, Body body, const CellMesh& cells, const View& view,
               Shapes& shapes);

/// Puts the actors of a scene into a renderer.
void fill(vtkRenderer& renderer, const Scene& scene, const View& view, const ColourScale& scale,
          double metres_per_pixel);

} // namespace tessera::post
