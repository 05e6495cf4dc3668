#include "postprocess/render/drawing.hpp"

#include "io/atomic_file.hpp"
#include "postprocess/animated_png.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render/body.hpp"
#include "postprocess/render/canvas.hpp"
#include "postprocess/render/cells.hpp"
#include "postprocess/render/colour_range.hpp"
#include "postprocess/render/legend.hpp"
#include "postprocess/render/scene.hpp"
#include "postprocess/render/view.hpp"

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
constexpr double least_width = 420, least_strip = 170, least_height = 300;

std::string caption_of(const Panel& panel) {
  const std::string time = std::isnan(panel.time) ? "" : "t = " + with_unit(panel.time, "s");
  if (panel.label.empty() || time.empty())
    return panel.label + time;
  return panel.label + ",  " + time;
}

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

struct Layout {
  double panel_width = 0, body_height = 0; ///< pixels
  double metres_per_pixel = 0;
};

/// Panels in a row of the picture.
std::size_t columns_of(const Drawing& drawing, std::size_t panels) {
  return drawing.one_by_one ? 1 : drawing.columns > 0 ? static_cast<std::size_t>(drawing.columns) : panels;
}

/// One length scale for all panels; the picture takes the shape of the bodies so that they fill it.
Layout layout_of(const std::vector<Scene>& scenes, const Drawing& drawing, bool plane) {
  double width = 0, height = 0;
  for (const Scene& scene : scenes) {
    width = std::max(width, static_cast<double>(scene.extent.sizes().x()));
    height = std::max(height, static_cast<double>(scene.extent.sizes().y()));
  }
  const auto columns = static_cast<double>(columns_of(drawing, scenes.size()));
  const double rows = drawing.one_by_one ? 1 : static_cast<double>(scenes.size()) / columns;
  const double widest_panel = std::min(1500.0, widest / columns);
  // Many rows are lower, yet not in proportion.
  const double highest = (plane ? wanted_plane_height : wanted_height) / std::sqrt(rows);
  Layout layout;
  layout.metres_per_pixel = std::max(width / widest_panel, height / highest);
  // Under the panels of a strip stands little more than the time.
  layout.panel_width =
      std::max(width / layout.metres_per_pixel, drawing.one_place && columns > 1 ? least_strip : least_width);
  layout.body_height = std::max(height / layout.metres_per_pixel, least_height);
  return layout;
}

/// Leaves out what cannot be shown of plane bodies, and says in the title what all panels have in common.
void settle_panels(Drawing& drawing, std::vector<Body>& bodies, bool plane) {
  const auto cut = [](const Panel& panel) { return !panel.clip.empty(); };
  const bool all_cut = std::all_of(drawing.panels.begin(), drawing.panels.end(), cut);
  if (plane && !all_cut) {
    // There is no inside to be seen: the cut panel beside a whole one would repeat it.
    for (std::size_t i = drawing.panels.size(); i-- > 0;)
      if (cut(drawing.panels[i])) {
        drawing.panels.erase(drawing.panels.begin() + static_cast<std::ptrdiff_t>(i));
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i));
      }
  } else if (!plane && all_cut) {
    const Panel& panel = drawing.panels.front();
    drawing.title += std::isnan(panel.clip_at)
                         ? ", cut in the middle"
                         : fmt::format(", cut at {} = {}", panel.clip, with_unit(panel.clip_at, "m"));
  }
}

/// What the panels show, on one colour scale.
struct Sheet {
  Drawing drawing;
  Quantity quantity;
  View view;
  Range range;
  ColourScale scale;
  std::vector<Scene> scenes;
  Layout layout;
};

Sheet sheet_of(const Drawing& asked) {
  Sheet sheet{asked, field_quantity(asked.field), {}, {}, {}, {}, {}};
  Drawing& drawing = sheet.drawing;
  if (drawing.cloud)
    sheet.quantity = {sheet.quantity.label + " / mean", "", sheet.quantity.palette, 0};
  std::vector<Body> bodies = read_bodies(drawing);
  const bool plane = std::all_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.plane; });
  sheet.view = view_of(plane ? "top" : drawing.view);
  settle_panels(drawing, bodies, plane);
  mask_unstressed(bodies);

  sheet.range = range_of(bodies, drawing.cloud ? 0.01 : 0.001);
  sheet.scale = scale_of(drawing, sheet.quantity, sheet.range);
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
  Shapes shapes;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    sheet.scenes.push_back(
        scene_of(drawing, drawing.panels[i], std::move(bodies[i]), cells[i], sheet.view, shapes));
  if (drawing.one_place) {
    Eigen::AlignedBox3f all;
    for (const Scene& scene : sheet.scenes)
      all.extend(scene.extent);
    for (Scene& scene : sheet.scenes)
      scene.extent = all;
  }
  sheet.layout = layout_of(sheet.scenes, drawing, plane);
  return sheet;
}

/// `count` of the sheet's panels from `first` on, row by row: the bytes of a PNG file.
std::string png_of(const Sheet& sheet, std::size_t first, std::size_t count) {
  const Layout& layout = sheet.layout;
  const std::size_t columns = columns_of(sheet.drawing, count), rows = (count + columns - 1) / columns;
  const double row_width =
      static_cast<double>(columns) * layout.panel_width + static_cast<double>(columns - 1) * gap;
  const double row_height = layout.body_height + caption_height;
  Canvas canvas(static_cast<int>(2 * margin + row_width + bar_column),
                static_cast<int>(title_height + static_cast<double>(rows) * row_height));
  const bool strips = sheet.drawing.one_place && columns > 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Scene& scene = sheet.scenes[first + i];
    const double left = margin + static_cast<double>(i % columns) * (layout.panel_width + gap);
    const double low = static_cast<double>(rows - 1 - i / columns) * row_height;
    vtkRenderer& renderer =
        canvas.scene({left, low + caption_height}, {left + layout.panel_width, low + row_height});
    fill(renderer, scene, sheet.view, sheet.scale, layout.metres_per_pixel);
    look_at(renderer, sheet.view, scene.extent, layout.body_height * layout.metres_per_pixel);
    const double centre = left + layout.panel_width / 2;
    Panel captioned = scene.panel;
    if (strips)
      captioned.label.clear();
    canvas.text({centre, low + caption_height - 40}, caption_of(captioned),
                {.size = 28, .anchor = Anchor::centre, .width = layout.panel_width});
    if (!strips)
      canvas.text({centre, low + caption_height - 80}, scene.second_line,
                  {.size = 22, .anchor = Anchor::centre, .width = layout.panel_width});
    else if (i % columns == 0)
      canvas.text({margin + row_width / 2, low + caption_height - 90}, scene.panel.label,
                  {.size = 28, .anchor = Anchor::centre, .width = row_width});
  }
  canvas.text({canvas.width() / 2.0, canvas.height() - title_height / 2}, sheet.drawing.title,
              {.size = 34, .anchor = Anchor::centre, .bold = true, .width = canvas.width() - 2 * margin});
  const double column = canvas.width() - bar_column;
  const double bodies_height = canvas.height() - title_height - caption_height;
  // Below the bar there is room for the extremes, above the scale of lengths.
  const double below = std::max(0.08 * layout.body_height, 70.0), above = 0.08 * layout.body_height;
  draw_bar(canvas, sheet.scale, sheet.quantity, sheet.range, {column, caption_height + below},
           bodies_height - below - above, bar_column);
  draw_length(canvas, layout.metres_per_pixel, {column, caption_height - 24});
  draw_axes(canvas, sheet.view, {column + 70, 44});
  return canvas.png();
}

} // namespace

void draw_body(const Drawing& drawing) {
  const Sheet sheet = sheet_of(drawing);
  if (!drawing.one_by_one) {
    io::write_text(drawing.file, png_of(sheet, 0, sheet.scenes.size()));
    return;
  }
  constexpr double seconds = 0.12; // a frame
  std::vector<std::string> frames;
  for (std::size_t i = 0; i < sheet.scenes.size(); ++i)
    frames.push_back(png_of(sheet, i, 1));
  io::write_text(drawing.file, animated_png(frames, seconds));
}

} // namespace tessera::post
