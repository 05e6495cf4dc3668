#include "postprocess/render/drawing.hpp"

#include "postprocess/cell_surfaces.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render/actors.hpp"
#include "postprocess/render/body.hpp"
#include "postprocess/render/canvas.hpp"
#include "postprocess/render/cells.hpp"
#include "postprocess/render/colour_range.hpp"
#include "postprocess/render/legend.hpp"
#include "postprocess/render/view.hpp"

#include <vtkRenderer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tessera::post {
namespace {

// Pixels of the layout, from the outside inwards.
constexpr double margin = 40, title_height = 90, caption_height = 180, bar_column = 260, gap = 30;
constexpr double wanted_height = 900; ///< of a body's part of the picture
constexpr double wanted_plane_height = 1300;
constexpr double widest = 2600; ///< of all bodies together
constexpr double least_width = 420, least_height = 300;

/// "13.4 × 13.4 × 21.5 mm": what a box spans along x, y and z.
std::string size_of(const Eigen::AlignedBox3f& box, bool plane) {
  const Eigen::Vector3d span = box.sizes().cast<double>();
  const Unit unit = readable_unit("m", span.maxCoeff());
  std::string text = fmt::format("{} × {}", figure(span.x() * unit.factor), figure(span.y() * unit.factor));
  if (!plane)
    text += " × " + figure(span.z() * unit.factor);
  return fmt::format("{} {}", text, unit.name);
}

std::string caption_of(const Panel& panel) {
  const std::string time = std::isnan(panel.time) ? "" : "t = " + with_unit(panel.time, "s");
  if (panel.label.empty() || time.empty())
    return panel.label + time;
  return panel.label + ",  " + time;
}

/// What the particles' centres span.
Eigen::AlignedBox3f span_of(const Body& body) {
  Eigen::AlignedBox3f box;
  for (const Point& p : body.points)
    box.extend(p);
  return box;
}

/// One panel as it is drawn.
struct Scene {
  Panel panel;
  Body body;
  CellSurfaces cells; ///< none: the particles are drawn
  std::string second_line;
  Eigen::AlignedBox3f extent; ///< in the view
};

/// All panels' bodies with the values the legend speaks of; a cloud's are relative to their mean.
std::vector<Body> read_bodies(const Drawing& drawing) {
  std::vector<Body> bodies;
  for (const Panel& panel : drawing.panels) {
    Body& body = bodies.emplace_back(read_body(panel, drawing.field));
    if (!drawing.cloud)
      continue;
    const double mean = std::accumulate(body.values.begin(), body.values.end(), 0.0) /
                        static_cast<double>(body.values.size());
    for (double& value : body.values)
      value /= mean;
    touch(body, panel.spacing > 0 ? 0.5 * panel.spacing : std::numeric_limits<double>::infinity());
  }
  return bodies;
}

/// `cells` are those of panel.cells.
Scene scene_of(const Drawing& drawing, const Panel& panel, Body body, const CellMesh& cells,
               const View& view) {
  Scene scene{panel, std::move(body), {}, "", {}};
  scene.second_line = size_of(drawing.cloud ? scene.body.reference : span_of(scene.body), scene.body.plane);
  // Cells ask for the values of all particles.
  std::vector<bool> kept(scene.body.points.size(), true);
  Body half = scene.body;
  if (!panel.clip.empty() && !half.plane) {
    kept = keep_far_half(half, panel.clip, view.into);
    if (drawing.cloud)
      scene.second_line = fmt::format("{} of {} shown", half.points.size(), scene.body.points.size());
  }
  if (panel.cells.empty()) {
    scene.body = std::move(half);
  } else {
    scene.cells = cell_surfaces(cells, kept, 1e-6 * scene.body.spacing);
    for (const Vec3& x : scene.cells.points)
      scene.extent.extend(view.seen(x.cast<float>()));
  }
  for (std::size_t i = 0; scene.cells.faces.empty() && i < scene.body.points.size(); ++i) {
    const Point at = view.seen(scene.body.points[i]);
    scene.extent.extend(Point(at.array() - scene.body.radii[i]));
    scene.extent.extend(Point(at.array() + scene.body.radii[i]));
  }
  if (drawing.outline)
    scene.extent.extend(extent(view, corners(scene.body.reference)));
  // Room for edges and dots before the cells, and for flat ones to have a depth at all.
  const auto air = static_cast<float>(0.5 * scene.body.spacing);
  scene.extent.min().z() -= air;
  scene.extent.max().z() += air;
  return scene;
}

void fill(vtkRenderer& renderer, const Scene& scene, const Drawing& drawing, const View& view,
          const ColourScale& scale, double metres_per_pixel) {
  const Optics optics{depth_of(scene.extent), metres_per_pixel};
  const auto spacing = static_cast<float>(scene.body.spacing);
  if (scene.cells.faces.empty()) {
    renderer.AddActor(spheres(scene.body, scale, optics));
  } else {
    renderer.AddActor(cell_faces(scene.cells, scene.body.values, scale));
    // Neither lines nor dots may hide the colours of small cells.
    const double cell = scene.body.spacing / metres_per_pixel;
    renderer.AddActor(cell_edges(scene.cells, -0.01f * spacing * view.into,
                                 static_cast<float>(std::clamp(cell / 14, 0.4, 1.4))));
    if (scene.body.plane && cell >= 14)
      renderer.AddActor(dots(scene.body, 0.2, optics));
  }
  if (drawing.outline)
    renderer.AddActor(box_lines(scene.body.reference));
}

struct Layout {
  double panel_width = 0, body_height = 0; ///< pixels
  double metres_per_pixel = 0;
};

/// One length scale for all panels; the picture takes the shape of the bodies so that they fill it.
Layout layout_of(const std::vector<Scene>& scenes, double tallest) {
  double width = 0, height = 0;
  for (const Scene& scene : scenes) {
    width = std::max(width, static_cast<double>(scene.extent.sizes().x()));
    height = std::max(height, static_cast<double>(scene.extent.sizes().y()));
  }
  const double widest_panel = std::min(1500.0, widest / static_cast<double>(scenes.size()));
  Layout layout;
  layout.metres_per_pixel = std::max(width / widest_panel, height / tallest);
  layout.panel_width = std::max(width / layout.metres_per_pixel, least_width);
  layout.body_height = std::max(height / layout.metres_per_pixel, least_height);
  return layout;
}

} // namespace

void draw_particles(const Drawing& asked) {
  Drawing drawing = asked;
  Quantity quantity = field_quantity(drawing.field);
  if (drawing.cloud)
    quantity = {quantity.label + " / mean", "", quantity.palette, 0};
  std::vector<Body> bodies = read_bodies(drawing);
  const bool plane = std::all_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.plane; });
  const View view = view_of(plane ? "top" : drawing.view);
  const auto cut = [](const Panel& panel) { return !panel.clip.empty(); };
  if (plane && !std::all_of(drawing.panels.begin(), drawing.panels.end(), cut)) {
    // There is no inside to be seen: the cut panel beside a whole one would repeat it.
    for (std::size_t i = drawing.panels.size(); i-- > 0;)
      if (cut(drawing.panels[i])) {
        drawing.panels.erase(drawing.panels.begin() + static_cast<std::ptrdiff_t>(i));
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i));
      }
  } else if (!plane && std::all_of(drawing.panels.begin(), drawing.panels.end(), cut)) {
    drawing.title += ", cut in the middle";
  }

  const Range range = range_of(bodies, drawing.cloud ? 0.01 : 0.001);
  const ColourScale scale = scale_of(drawing, quantity, range);
  std::vector<CellMesh> cells(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (drawing.panels[i].cells.empty())
      continue;
    cells[i] = read_cells(drawing.panels[i].cells);
    // Cells reach to the boundary, particles need not: all panels show one body.
    for (Body& body : bodies)
      for (const Vec3& x : cells[i].points)
        body.reference.extend(x.cast<float>());
  }
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    scenes.push_back(scene_of(drawing, drawing.panels[i], std::move(bodies[i]), cells[i], view));
  const Layout layout = layout_of(scenes, plane ? wanted_plane_height : wanted_height);
  const auto count = static_cast<double>(scenes.size());
  const double bodies_width = count * layout.panel_width + (count - 1) * gap;
  Canvas canvas(static_cast<int>(2 * margin + bodies_width + bar_column),
                static_cast<int>(title_height + layout.body_height + caption_height));

  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const double left = margin + static_cast<double>(i) * (layout.panel_width + gap);
    vtkRenderer& renderer = canvas.scene({left, caption_height},
                                         {left + layout.panel_width, caption_height + layout.body_height});
    fill(renderer, scenes[i], drawing, view, scale, layout.metres_per_pixel);
    look_at(renderer, view, scenes[i].extent, layout.body_height * layout.metres_per_pixel);
    const double centre = left + layout.panel_width / 2;
    canvas.text({centre, caption_height - 40}, caption_of(scenes[i].panel),
                {.size = 28, .anchor = Anchor::centre, .width = layout.panel_width});
    canvas.text({centre, caption_height - 80}, scenes[i].second_line,
                {.size = 22, .anchor = Anchor::centre, .width = layout.panel_width});
  }
  canvas.text({canvas.width() / 2.0, canvas.height() - title_height / 2}, drawing.title,
              {.size = 34, .anchor = Anchor::centre, .bold = true, .width = canvas.width() - 2 * margin});
  const double column = canvas.width() - bar_column;
  draw_bar(canvas, scale, quantity, range, {column, caption_height + 0.08 * layout.body_height},
           0.84 * layout.body_height, bar_column);
  draw_length(canvas, layout.metres_per_pixel, {column, caption_height - 24});
  draw_axes(canvas, view, {column + 70, 44});
  canvas.save(drawing.file);
}

} // namespace tessera::post
