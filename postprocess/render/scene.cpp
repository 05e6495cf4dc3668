#include "postprocess/render/scene.hpp"

#include "core/error.hpp"
#include "io/body_file.hpp"
#include "io/cloud_file.hpp"
#include "postprocess/outline.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render/actors.hpp"

#include <vtkRenderer.h>

#include <fmt/format.h>

#include <algorithm>

namespace tessera::post {
namespace {

/// "13.4 × 13.4 × 21.5 mm": what a box spans along x, y and z.
std::string size_of(const Eigen::AlignedBox3f& box, bool plane) {
  const Eigen::Vector3d span = box.sizes().cast<double>();
  const Unit unit = readable_unit("m", span.maxCoeff());
  std::string text = fmt::format("{} × {}", figure(span.x() * unit.factor), figure(span.y() * unit.factor));
  if (!plane)
    text += " × " + figure(span.z() * unit.factor);
  return fmt::format("{} {}", text, unit.name);
}

Eigen::AlignedBox3f box_of(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3f box;
  for (const Vec3& x : points)
    box.extend(x.cast<float>());
  return box;
}

std::vector<std::array<Vec3, 2>> lines_of(const CutBody& body,
                                          const std::vector<std::array<std::int32_t, 2>>& edges) {
  std::vector<std::array<Vec3, 2>> lines;
  for (const auto& [a, b] : edges)
    lines.push_back({body.points[a], body.points[b]});
  return lines;
}

/// The undeformed body, cut like the deformed one where it is itself in the way.
std::vector<std::array<Vec3, 2>> outline_in(const Panel& panel, const View& view, const Body& body,
                                            Shapes& shapes) {
  if (panel.body.empty())
    return box_lines(body.reference);
  const BodyMesh& mesh = shapes.body(panel.body);
  const bool cut = !panel.clip.empty() && mesh.dimension == 3;
  return outline_of(cut ? cut_body(mesh, {}, cut_plane(panel, box_of(mesh.points), view.into))
                        : whole_body(mesh, {}),
                    view.into.cast<double>());
}

/// Of the tools' bands beside lines, m.
double band_width(const Body& body) {
  return 0.04 * double{body.reference.sizes().norm()};
}

CutBody skin_in(const Panel& panel, const View& view, const Body& body, Shapes& shapes) {
  const Skin& skin = shapes.skin(panel);
  BodyMesh mesh = skin.mesh;
  mesh.points = moved(skin, body.displacement);
  const std::vector<double> values = values_on(skin, body.values);
  if (panel.clip.empty() || body.plane)
    return whole_body(mesh, values);
  CutBody half = cut_body(mesh, values, cut_plane(panel, span_of(body), view.into));
  require(!half.skin.empty(), fmt::format("nothing of the body lies beyond the cut across {}", panel.clip),
          panel.file, "cut it elsewhere, or leave clip_at out for its middle");
  return half;
}

} // namespace

const BodyMesh& Shapes::body(const std::string& file) {
  const auto found = bodies_.find(file);
  return found != bodies_.end() ? found->second : bodies_.emplace(file, io::read_body(file)).first->second;
}

const Skin& Shapes::skin(const Panel& panel) {
  const std::array key{panel.body, panel.cloud, panel.clip.empty() ? std::string() : "inside"};
  const auto found = skins_.find(key);
  return found != skins_.end()
             ? found->second
             : skins_
                   .emplace(key, skin_of(body(panel.body), io::read_cloud(panel.cloud), !panel.clip.empty()))
                   .first->second;
}

Scene scene_of(const Drawing& drawing, const Panel& panel, Body body, const CellMesh& cells, const View& view,
               Shapes& shapes) {
  Scene scene{panel, std::move(body), {}, {}, {}, {}, "", {}};
  if (panel.magnify == 1)
    scene.second_line = size_of(drawing.cloud ? scene.body.reference : span_of(scene.body), scene.body.plane);
  if (!drawing.tools.empty())
    scene.tools = tool_shapes(drawing.tools, panel.time, view,
                              span_of(scene.body).merged(scene.body.reference), band_width(scene.body));
  const bool cut = !panel.clip.empty() && !scene.body.plane;
  const auto plane = [&] { return cut_plane(panel, span_of(scene.body), view.into); };
  const auto show = [&](const Vec3& x) { scene.extent.extend(view.seen(x.cast<float>())); };
  if (drawing.outline)
    scene.outline = outline_in(panel, view, scene.body, shapes);
  if (!panel.cells.empty()) { // cells ask for the values of all particles
    Body half = scene.body;
    std::vector<bool> kept(scene.body.points.size(), true);
    if (cut) {
      kept = keep_beyond(half, plane());
      scene.second_line = fmt::format("{} of {} shown", half.points.size(), scene.body.points.size());
    }
    scene.cells = cell_surfaces(cells, kept, 1e-6 * scene.body.spacing);
    std::for_each(scene.cells.points.begin(), scene.cells.points.end(), show);
  } else if (drawing.skin && !panel.body.empty() && !panel.cloud.empty()) {
    scene.skin = skin_in(panel, view, scene.body, shapes);
    std::for_each(scene.skin->points.begin(), scene.skin->points.end(), show);
  } else {
    const std::size_t all = scene.body.points.size();
    if (cut)
      keep_beyond(scene.body, plane());
    if (cut && drawing.cloud)
      scene.second_line = fmt::format("{} of {} shown", scene.body.points.size(), all);
    for (std::size_t i = 0; i < scene.body.points.size(); ++i) {
      const Point at = view.seen(scene.body.points[i]);
      scene.extent.extend(Point(at.array() - scene.body.radii[i]));
      scene.extent.extend(Point(at.array() + scene.body.radii[i]));
    }
  }
  for (const auto& [a, b] : scene.outline) {
    show(a);
    show(b);
  }
  for (const auto& floor : scene.tools.floors)
    std::for_each(floor.begin(), floor.end(), show);
  if (!scene.tools.lines.empty()) { // that bound the body
    const auto room = static_cast<float>(band_width(scene.body));
    scene.extent.min().head<2>().array() -= room;
    scene.extent.max().head<2>().array() += room;
  }
  // Lines along the rim are to be seen in their whole width.
  const float rim = 0.006f * scene.extent.sizes().head<2>().maxCoeff();
  scene.extent.min().head<2>().array() -= rim;
  scene.extent.max().head<2>().array() += rim;
  // Room for edges and dots before the cells, and for flat ones to have a depth at all.
  const auto air = static_cast<float>(0.5 * scene.body.spacing);
  scene.extent.min().z() -= air;
  scene.extent.max().z() += air;
  return scene;
}

void fill(vtkRenderer& renderer, const Scene& scene, const View& view, const ColourScale& scale,
          double metres_per_pixel) {
  const Optics optics{depth_of(scene.extent), metres_per_pixel};
  const auto spacing = static_cast<float>(scene.body.spacing);
  const Point nearer = -0.1f * spacing * view.into;
  if (!scene.cells.faces.empty()) {
    renderer.AddActor(cell_faces(scene.cells, scene.body.values, scale));
    // Neither lines nor dots may hide the colours of small cells.
    const double cell = scene.body.spacing / metres_per_pixel;
    renderer.AddActor(
        cell_edges(scene.cells, 0.1f * nearer, static_cast<float>(std::clamp(cell / 14, 0.4, 1.4))));
    if (scene.body.plane && cell >= 14)
      renderer.AddActor(dots(scene.body, 0.2, optics));
  } else if (scene.skin) {
    const CutBody& skin = *scene.skin;
    renderer.AddActor(scene.body.plane ? flat_faces(skin, skin.skin, scale) : skin_faces(skin, scale));
    renderer.AddActor(flat_faces(skin, skin.section, scale));
    for (const auto* edges : {&skin.edges, &skin.rim})
      renderer.AddActor(drawn_lines(lines_of(skin, *edges), {0.15, 1.5}, nearer));
  } else {
    renderer.AddActor(spheres(scene.body, scale, optics));
  }
  // Tools seen edge-on lie behind everything.
  const double last = double{scene.extent.max().z()} - 0.1 * spacing;
  const auto behind = [&](auto shapes, double depth) {
    const Vec3 into = view.into.cast<double>();
    for (auto& shape : shapes)
      for (Vec3& x : shape)
        x += (depth - x.dot(into)) * into;
    return shapes;
  };
  renderer.AddActor(grey_faces(behind(scene.tools.bands, last), 0.87));
  renderer.AddActor(drawn_lines(behind(scene.tools.lines, last - 0.1 * spacing), {0.35, 2.5}));
  renderer.AddActor(grey_faces(scene.tools.floors, 0.87));
  renderer.AddActor(drawn_lines(scene.outline, {0.5, 2}, nearer));
}

} // namespace tessera::post
