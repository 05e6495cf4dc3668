#include "postprocess/render/tools.hpp"

#include <cmath>

namespace tessera::post {
namespace {

/// `side`: the direction to the left of the line as it is seen, where the body is; bands lie on the right.
void add_line(const std::vector<Vec3>& points, const Vec3& into, double band, ToolShapes& shapes) {
  // The bisector at each point, as long as brings both pieces' bands to one width.
  std::vector<Vec3> right;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 before = (points[i] - points[i > 0 ? i - 1 : 0]).normalized().cross(into);
    const Vec3 after = (points[i + 1 < points.size() ? i + 1 : i] - points[i]).normalized().cross(into);
    const Vec3 sum = before + after;
    right.push_back(sum.squaredNorm() > 0 ? Vec3(-2 / std::max(sum.squaredNorm(), 1.0) * sum) : Vec3::Zero());
    if (before.isZero() || after.isZero())
      right.back() = -(before + after);
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    shapes.lines.push_back({points[i], points[i + 1]});
    shapes.bands.push_back(
        {points[i], points[i + 1], points[i + 1] + band * right[i + 1], points[i] + band * right[i]});
  }
}

/// What the body covers of a plane seen from straight above it, and a little more.
std::array<Vec3, 4> floor_of(const Vec3& point, const Vec3& normal, const Eigen::AlignedBox3f& around) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  const Vec3 v = normal.cross(Vec3(Vec3::Unit(axis))).normalized(), u = v.cross(normal);
  Eigen::AlignedBox2d covered;
  for (const Point& corner : corners(around)) {
    const Vec3 from = corner.cast<double>() - point;
    covered.extend(Vec<2>(from.dot(u), from.dot(v)));
  }
  const double margin = 0.15 * covered.sizes().maxCoeff();
  const Vec<2> low = covered.min().array() - margin, high = covered.max().array() + margin;
  return {point + low.x() * u + low.y() * v, point + high.x() * u + low.y() * v,
          point + high.x() * u + high.y() * v, point + low.x() * u + high.y() * v};
}

} // namespace

ToolShapes tool_shapes(const std::vector<Tool>& tools, double time, const View& view,
                       const Eigen::AlignedBox3f& around, double band) {
  constexpr double edge_on = 0.02; // sine of the angle to the line of sight
  const Vec3 into = view.into.cast<double>();
  const double reach = 100 * double{around.sizes().norm()};
  ToolShapes shapes;
  for (const Tool& tool : tools) {
    const Vec3 way = std::isnan(time) ? Vec3(Vec3::Zero()) : Vec3(time * tool.velocity);
    if (!tool.line.empty()) {
      std::vector<Vec3> points;
      for (const Vec3& x : tool.line)
        points.push_back(x + way);
      add_line(points, into, band, shapes);
      continue;
    }
    const Vec3 middle = around.center().cast<double>();
    const Vec3 foot = middle - tool.normal.dot(middle - tool.point - way) * tool.normal;
    if (std::abs(tool.normal.dot(into)) < edge_on) {
      const Vec3 along = into.cross(tool.normal).normalized(); // the normal is on its left
      add_line({foot - reach * along, foot + reach * along}, into, band, shapes);
    } else if (tool.normal.dot(into) < 0) {
      shapes.floors.push_back(floor_of(foot, tool.normal, around));
    }
  }
  return shapes;
}

} // namespace tessera::post
