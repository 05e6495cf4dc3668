#include "preprocess/geometry/importer/shapes.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace tessera::importer {
namespace {

namespace occ = gmsh::model::occ;
using preprocess::ShapeSpec;

/// Polygon in z = 0 as a surface.
int polygon(const std::vector<std::array<double, 2>>& corners) {
  std::vector<int> points, lines;
  for (const auto& [x, y] : corners)
    points.push_back(occ::addPoint(x, y, 0));
  for (std::size_t i = 0; i < points.size(); ++i)
    lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
  return occ::addPlaneSurface({occ::addCurveLoop(lines)});
}

/// Drawn out along z to a solid; left as it is in the plane.
void draw_out(int surface, double depth, int dimension) {
  if (dimension == 2)
    return;
  gmsh::vectorpair out;
  occ::extrude({{2, surface}}, 0, 0, depth, out);
}

void cut(int dimension, int from, int what) {
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{dimension, from}}, {{dimension, what}}, out, map);
}

/// Of a face (an edge, in the plane): centre of mass, and area (length).
struct Place {
  double x, y, z, measure;
};

std::string name_of(const ShapeSpec& shape, const Place& at) {
  const auto& l = shape.lengths;
  const auto& size = l[0];
  const double across = *std::max_element(size.begin(), size.end());
  const auto near = [&](double a, double b) { return std::abs(a - b) < 1e-6 * across; };
  if (shape.name == "sphere" || shape.name == "disc")
    return "side";
  if (shape.name == "ring")
    return at.measure > std::numbers::pi * (l[0][0] + l[1][0]) ? "side" : "bore";
  if (shape.name == "cylinder" || shape.name == "tube") {
    const double height = l.back()[0];
    if (at.z < 0.25 * height)
      return "bottom";
    if (at.z > 0.75 * height)
      return "top";
    const bool outside =
        shape.name == "cylinder" || at.measure > std::numbers::pi * (l[0][0] + l[1][0]) * height;
    return outside ? "side" : "bore";
  }
  const bool plane = size.size() == 2;
  if (!plane && near(at.z, 0))
    return "z_min";
  if (!plane && near(at.z, size[2]))
    return "z_max";
  if (near(at.x, 0))
    return plane ? "left" : "x_min";
  if (near(at.x, size[0]))
    return plane ? "right" : "x_max";
  if (near(at.y, 0))
    return plane ? "bottom" : "y_min";
  if (near(at.y, size[1]))
    return plane ? "top" : "y_max";
  if (shape.name == "plate_with_hole")
    return "hole";
  if (shape.name == "l_part")
    return near(at.x, l[1][0]) ? "inner_x" : "inner_y";
  if (near(at.y, size[1] - l[1][0]))
    return "flange_under";
  return at.x < size[0] / 2 ? "web_left" : "web_right";
}

} // namespace

void draw_shape(const ShapeSpec& shape, int dimension) {
  const auto& l = shape.lengths;
  const double depth = dimension == 3 && l[0].size() == 3 ? l[0][2] : 0;
  gmsh::model::add(shape.name);
  if (shape.name == "box") {
    occ::addBox(0, 0, 0, l[0][0], l[0][1], l[0][2]);
  } else if (shape.name == "cylinder") {
    occ::addCylinder(0, 0, 0, 0, 0, l[1][0], l[0][0]);
  } else if (shape.name == "sphere") {
    occ::addSphere(0, 0, 0, l[0][0]);
  } else if (shape.name == "tube") {
    const int outer = occ::addCylinder(0, 0, 0, 0, 0, l[2][0], l[0][0]);
    cut(3, outer, occ::addCylinder(0, 0, -l[2][0], 0, 0, 3 * l[2][0], l[1][0]));
  } else if (shape.name == "rectangle") {
    occ::addRectangle(0, 0, 0, l[0][0], l[0][1]);
  } else if (shape.name == "disc") {
    occ::addDisk(0, 0, 0, l[0][0], l[0][0]);
  } else if (shape.name == "ring") {
    const int outer = occ::addDisk(0, 0, 0, l[0][0], l[0][0]);
    cut(2, outer, occ::addDisk(0, 0, 0, l[1][0], l[1][0]));
  } else if (shape.name == "plate_with_hole") {
    const double x = l[0][0] / 2, y = l[0][1] / 2, r = l[1][0];
    if (dimension == 2)
      cut(2, occ::addRectangle(0, 0, 0, l[0][0], l[0][1]), occ::addDisk(x, y, 0, r, r));
    else
      cut(3, occ::addBox(0, 0, 0, l[0][0], l[0][1], depth),
          occ::addCylinder(x, y, -depth, 0, 0, 3 * depth, r));
  } else if (shape.name == "l_part") {
    const double a = l[0][0], b = l[0][1], t = l[1][0];
    draw_out(polygon({{0, 0}, {a, 0}, {a, t}, {t, t}, {t, b}, {0, b}}), depth, dimension);
  } else if (shape.name == "t_part") {
    const double a = l[0][0], b = l[0][1], t = l[1][0], left = (a - t) / 2, right = (a + t) / 2;
    draw_out(
        polygon(
            {{left, 0}, {right, 0}, {right, b - t}, {a, b - t}, {a, b}, {0, b}, {0, b - t}, {left, b - t}}),
        depth, dimension);
  }
  occ::synchronize();
}

std::vector<std::string> shape_names(const ShapeSpec& shape, int dimension, const std::vector<int>& tags) {
  std::vector<std::string> names;
  for (const int tag : tags) {
    Place at{};
    occ::getCenterOfMass(dimension - 1, tag, at.x, at.y, at.z);
    occ::getMass(dimension - 1, tag, at.measure);
    names.push_back(name_of(shape, at));
  }
  return names;
}

} // namespace tessera::importer
