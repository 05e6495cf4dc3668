#include "postprocess/render/drawing.hpp"

#include "core/error.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render/body.hpp"
#include "postprocess/render/canvas.hpp"
#include "postprocess/render/ticks.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tessera::post {
namespace {

using Direction = Eigen::Vector3f;

/// Half the diagonal of a lattice cell's face: nothing shines through between the spheres.
constexpr double radius_over_spacing = 0.71;

// Pixels of the layout, from the outside inwards.
constexpr double margin = 40, title_height = 90, caption_height = 180, bar_column = 260, gap = 30;
constexpr double wanted_height = 900; ///< of a body's part of the picture
constexpr double widest = 2600;       ///< of all bodies together
constexpr double least_width = 420, least_height = 300;

/// The orthonormal frame of a view: to the right, up, and into the picture.
struct View {
  Direction right, up, into;
};

View view_of(const std::string& name) {
  const Direction x = Direction::UnitX(), y = Direction::UnitY(), z = Direction::UnitZ();
  if (name == "back")
    return {-x, z, -y};
  if (name == "left")
    return {-y, z, x};
  if (name == "right")
    return {y, z, -x};
  if (name == "top")
    return {x, y, -z};
  if (name == "bottom")
    return {x, -y, z};
  if (name == "iso") {
    const Direction into = Direction(-0.75f, 1.0f, -0.6f).normalized();
    const Direction right = into.cross(z).normalized();
    return {right, right.cross(into), into};
  }
  require(name == "front", fmt::format("no view is named '{}'", name), "",
          "front, back, left, right, top, bottom and iso are");
  return {x, z, y};
}

/// Extent of points in a view: (right, up, into).
Eigen::AlignedBox3f extent(const View& view, const std::vector<Point>& points) {
  Eigen::AlignedBox3f box;
  for (const Point& p : points)
    box.extend(Point(p.dot(view.right), p.dot(view.up), p.dot(view.into)));
  return box;
}

std::vector<Point> corners(const Eigen::AlignedBox3f& box) {
  std::vector<Point> out;
  for (int c = 0; c < 8; ++c)
    out.push_back(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(c)));
  return out;
}

struct Range {
  double low = 0, high = 0;               ///< of all values
  double likely_low = 0, likely_high = 0; ///< of all but the outermost 0.1 % on each side
};

Range range_of(const std::vector<Body>& bodies) {
  std::vector<double> all;
  for (const Body& body : bodies)
    std::copy_if(body.values.begin(), body.values.end(), std::back_inserter(all),
                 [](double v) { return std::isfinite(v); });
  if (all.empty())
    return {};
  std::sort(all.begin(), all.end());
  const std::size_t tail = all.size() / 1000;
  return {all.front(), all.back(), all[tail], all[all.size() - 1 - tail]};
}

/// Where a handful of particles lies far out (a spurious strain of 150 beside a body at 3) they would hide
/// the body: then the scale ends where the others do. The largest value is printed beside the scale in any
/// case.
ColourScale scale_of(const Drawing& drawing, const Quantity& quantity, const Range& range) {
  const double likely = std::max(range.likely_high - range.likely_low, 1e-300);
  double low = range.low < range.likely_low - likely ? range.likely_low : range.low;
  double high = range.high > range.likely_high + likely ? range.likely_high : range.high;
  ColourScale scale;
  scale.two_sided = quantity.palette == Palette::diverging;
  if (scale.two_sided) {
    const double reach = std::max(std::abs(high - quantity.centre), std::abs(low - quantity.centre));
    low = quantity.centre - reach;
    high = quantity.centre + reach;
  } else if (quantity.palette == Palette::from_zero && low > 0) {
    low = 0;
  }
  scale.minimum = std::isnan(drawing.minimum) ? low : drawing.minimum;
  scale.maximum = std::isnan(drawing.maximum) ? high : drawing.maximum;
  const double size = std::max(std::abs(scale.minimum), std::abs(scale.maximum));
  if (scale.maximum - scale.minimum <= 1e-6 * size ||
      size == 0) { // one colour: the middle of a scale about it
    const double half = size == 0 ? 1 : 0.05 * size;
    if (std::isnan(drawing.minimum) && !(quantity.palette == Palette::from_zero && size == 0))
      scale.minimum -= half;
    scale.maximum += half;
  }
  return scale;
}

vtkSmartPointer<vtkActor> spheres(const Body& body, const ColourScale& scale, double radius, double depth) {
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("colour");
  colours->SetNumberOfComponents(3);
  points->SetNumberOfPoints(static_cast<vtkIdType>(body.points.size()));
  colours->SetNumberOfTuples(static_cast<vtkIdType>(body.points.size()));
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    points->SetPoint(static_cast<vtkIdType>(i), body.points[i].data());
    const Colour colour = scale(body.values[i]);
    colours->SetTypedTuple(static_cast<vtkIdType>(i), colour.data());
  }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->SetScalars(colours);
  const vtkNew<vtkPointGaussianMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScaleFactor(radius);
  mapper->SetTriangleScale(1.0f);
  mapper->EmissiveOff();
  // Each splat becomes a sphere: lit from the upper left, with its true depth so that neighbours meet in
  // arcs.
  mapper->SetSplatShaderCode(
      fmt::format("//VTK::Color::Impl\n"
                  "float across2 = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
                  "if (across2 > 1.0) discard;\n"
                  "float height = sqrt(1.0 - across2);\n"
                  "vec3 outwards = vec3(offsetVCVSOutput.xy, height);\n"
                  "float light = max(0.0, dot(outwards, vec3(-0.30, 0.40, 0.866)));\n"
                  "float shine = 0.16 * pow(light, 24.0);\n"
                  "ambientColor = vec3(0.0);\n"
                  "diffuseColor = (0.50 + 0.53 * light) * diffuseColor + vec3(shine);\n"
                  "gl_FragDepth = gl_FragCoord.z - {:.9f} * height;\n",
                  radius / depth)
          .c_str());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> box_lines(const Eigen::AlignedBox3f& box) {
  const vtkNew<vtkPoints> points;
  for (const Point& p : corners(box))
    points->InsertNextPoint(p.data());
  const vtkNew<vtkCellArray> lines;
  for (vtkIdType a = 0; a < 8; ++a)
    for (const vtkIdType bit : {1, 2, 4}) {
      const vtkIdType ends[2] = {a, a | bit};
      if (ends[0] != ends[1])
        lines->InsertNextCell(2, ends);
    }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.45, 0.45, 0.45);
  actor->GetProperty()->SetLineWidth(2);
  return actor;
}

/// The colour bar with its numbers, label and the true extremes.
void draw_bar(Canvas& canvas, const ColourScale& scale, const Quantity& quantity, const Range& range,
              double left) {
  const double low = caption_height + 0.08 * (canvas.height() - caption_height - title_height);
  const double high =
      canvas.height() - title_height - 0.08 * (canvas.height() - caption_height - title_height);
  constexpr double thickness = 34;
  constexpr int slices = 200;
  const auto at = [&](double value) {
    return low + (value - scale.minimum) / (scale.maximum - scale.minimum) * (high - low);
  };
  for (int s = 0; s < slices; ++s) {
    const double value = scale.minimum + (s + 0.5) / slices * (scale.maximum - scale.minimum);
    canvas.rectangle({left, low + (high - low) * s / slices},
                     {left + thickness, low + (high - low) * (s + 1) / slices + 1}, scale(value));
  }
  const Unit unit = readable_unit(quantity.unit, std::max(std::abs(scale.minimum), std::abs(scale.maximum)));
  for (const double tick : round_ticks(scale.minimum * unit.factor, scale.maximum * unit.factor, 6)) {
    const double y = at(tick / unit.factor);
    canvas.line({left + thickness, y}, {left + thickness + 8, y}, {80, 80, 80}, 2);
    canvas.text({left + thickness + 16, y}, figure(tick));
  }
  canvas.text({left + 155, (low + high) / 2}, titled(quantity.label, unit.name),
              {.size = 28, .anchor = Anchor::centre, .upwards = true});
  const auto extreme = [&](double value) { return fmt::format("{:.3g}", value * unit.factor); };
  const std::string extremes = range.low == range.high
                                   ? fmt::format("{} everywhere", extreme(range.low))
                                   : fmt::format("from {} to {}", extreme(range.low), extreme(range.high));
  canvas.text({left, low - 40}, extremes, {.size = 21, .width = bar_column - 20});
}

/// Short arrows of the coordinate axes.
void draw_axes(Canvas& canvas, const View& view, Pixel at) {
  constexpr double length = 42;
  const char* names[] = {"x", "y", "z"};
  const Colour colours[] = {{200, 40, 40}, {30, 140, 60}, {40, 80, 200}};
  for (int axis = 0; axis < 3; ++axis) {
    const double right = view.right[axis], up = view.up[axis], shown = std::hypot(right, up);
    if (shown < 0.1)
      continue; // towards the viewer
    const Pixel tip{at.x + length * right, at.y + length * up};
    canvas.line(at, tip, colours[axis], 4);
    canvas.text({tip.x + 16 * right / shown, tip.y + 16 * up / shown}, names[axis],
                {.size = 22, .anchor = Anchor::centre});
  }
}

/// A bar of round length, with that length beside it.
void draw_length(Canvas& canvas, double metres_per_pixel, Pixel at) {
  const double length = round_length(130 * metres_per_pixel);
  const double pixels = length / metres_per_pixel;
  canvas.line(at, {at.x + pixels, at.y}, {40, 40, 40}, 5);
  canvas.text({at.x + pixels + 14, at.y}, with_unit(length, "m"), {.size = 22});
}

/// "13.4 × 13.4 × 21.5 mm": what the particles' centres span along x, y and z.
std::string size_of(const Body& body) {
  Eigen::AlignedBox3f box;
  for (const Point& p : body.points)
    box.extend(p);
  const Eigen::Vector3d span = box.sizes().cast<double>();
  const Unit unit = readable_unit("m", span.maxCoeff());
  std::string text = fmt::format("{} × {}", figure(span.x() * unit.factor), figure(span.y() * unit.factor));
  if (!body.plane)
    text += " × " + figure(span.z() * unit.factor);
  return fmt::format("{} {}", text, unit.name);
}

struct Layout {
  double panel_width = 0, body_height = 0; ///< pixels
  double metres_per_pixel = 0;
};

/// One length scale for all panels; the picture takes the shape of the bodies so that they fill it.
Layout layout_of(const std::vector<Eigen::AlignedBox3f>& extents) {
  double width = 0, height = 0;
  for (const auto& box : extents) {
    width = std::max(width, static_cast<double>(box.sizes().x()));
    height = std::max(height, static_cast<double>(box.sizes().y()));
  }
  const double widest_panel = std::min(1500.0, widest / static_cast<double>(extents.size()));
  Layout layout;
  layout.metres_per_pixel = std::max(width / widest_panel, height / wanted_height);
  layout.panel_width = std::max(width / layout.metres_per_pixel, least_width);
  layout.body_height = std::max(height / layout.metres_per_pixel, least_height);
  return layout;
}

std::string caption_of(const Panel& panel) {
  const std::string time = std::isnan(panel.time) ? "" : "t = " + with_unit(panel.time, "s");
  if (panel.label.empty() || time.empty())
    return panel.label + time;
  return panel.label + ",  " + time;
}

} // namespace

void draw_particles(const Drawing& asked) {
  Drawing drawing = asked;
  const Quantity quantity = field_quantity(drawing.field);
  std::vector<Body> bodies;
  for (const Panel& panel : drawing.panels)
    bodies.push_back(read_body(panel, drawing.field));
  const Range range = range_of(bodies);
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

  std::vector<Eigen::AlignedBox3f> extents;
  std::vector<std::string> sizes;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    sizes.push_back(size_of(bodies[i]));
    const std::string& clip = drawing.panels[i].clip;
    if (!clip.empty() && !plane)
      keep_far_half(bodies[i], clip, view.into);
    Eigen::AlignedBox3f box = extent(view, bodies[i].points);
    const auto radius = static_cast<float>(radius_over_spacing * bodies[i].spacing);
    box.min().array() -= radius;
    box.max().array() += radius;
    if (drawing.outline)
      box.extend(extent(view, corners(bodies[i].reference)));
    extents.push_back(box);
  }
  const ColourScale scale = scale_of(drawing, quantity, range);
  const Layout layout = layout_of(extents);
  const auto count = static_cast<double>(bodies.size());
  const double bodies_width = count * layout.panel_width + (count - 1) * gap;
  Canvas canvas(static_cast<int>(2 * margin + bodies_width + bar_column),
                static_cast<int>(title_height + layout.body_height + caption_height));

  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Eigen::AlignedBox3f& box = extents[i];
    const double left = margin + static_cast<double>(i) * (layout.panel_width + gap);
    vtkRenderer& renderer = canvas.scene({left, caption_height},
                                         {left + layout.panel_width, caption_height + layout.body_height});
    const double depth = 1.1 * static_cast<double>(box.sizes().z());
    renderer.AddActor(spheres(bodies[i], scale, radius_over_spacing * bodies[i].spacing, depth));
    if (drawing.outline)
      renderer.AddActor(box_lines(bodies[i].reference));
    const Point middle = box.center();
    const Direction focus = middle.x() * view.right + middle.y() * view.up + middle.z() * view.into;
    const Direction eye = focus - static_cast<float>(depth) * view.into;
    vtkCamera& camera = *renderer.GetActiveCamera();
    camera.ParallelProjectionOn();
    camera.SetFocalPoint(focus.x(), focus.y(), focus.z());
    camera.SetPosition(eye.x(), eye.y(), eye.z());
    camera.SetViewUp(view.up.x(), view.up.y(), view.up.z());
    camera.SetParallelScale(layout.body_height / 2 * layout.metres_per_pixel);
    camera.SetClippingRange(0.5 * depth, 1.5 * depth);

    const double centre = left + layout.panel_width / 2;
    const TextStyle caption{.size = 28, .anchor = Anchor::centre, .width = layout.panel_width};
    canvas.text({centre, caption_height - 40}, caption_of(drawing.panels[i]), caption);
    canvas.text({centre, caption_height - 80}, sizes[i],
                {.size = 22, .anchor = Anchor::centre, .width = layout.panel_width});
  }
  canvas.text({canvas.width() / 2.0, canvas.height() - title_height / 2}, drawing.title,
              {.size = 34, .anchor = Anchor::centre, .bold = true, .width = canvas.width() - 2 * margin});
  draw_bar(canvas, scale, quantity, range, canvas.width() - bar_column);
  const double column = canvas.width() - bar_column;
  draw_length(canvas, layout.metres_per_pixel, {column, caption_height - 36});
  const bool downwards = (view.up.array() < -0.1f).any(); // arrows that point down need their room below
  draw_axes(canvas, view, {column + 70, downwards ? 78.0 : 54.0});
  canvas.save(drawing.file);
}

} // namespace tessera::post
