#include "preprocess/geometry/importer/cad_model.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/cad_file.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"
#include "preprocess/geometry/importer/sew.hpp"
#include "preprocess/geometry/importer/shapes.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace tessera::importer {
namespace {

/// Unit direction in which a curve leaves one of its ends (a short secant: derivatives may vanish there).
std::optional<Vec3> direction_at_end(int curve, bool at_start) {
  std::vector<double> low, high, X, Y;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  if (low.empty() || !(high[0] > low[0]))
    return {};
  const double step = 1e-4 * (high[0] - low[0]);
  gmsh::model::getValue(1, curve, {at_start ? low[0] : high[0]}, X);
  gmsh::model::getValue(1, curve, {at_start ? low[0] + step : high[0] - step}, Y);
  const Vec3 d(Y[0] - X[0], Y[1] - X[1], Y[2] - X[2]);
  if (!(d.norm() > 0))
    return {};
  return d.normalized();
}

} // namespace

void open_cad(const Request& request) {
  if (request.shape) {
    draw_shape(*request.shape, request.dimension);
    const std::string complaint = first_complaint();
    require(complaint.empty(), "the shape cannot be drawn: " + complaint, request.name,
            "give lengths that are not so far apart");
    return;
  }
  if (!request.cad_unit.empty())
    gmsh::option::setString("Geometry.OCCTargetUnit", request.cad_unit);
  open_file(request.file, request.name);
  if (request.dimension == 3 && preprocess::check_cad_file(request.file) != preprocess::CadFormat::geo)
    sew_surfaces(request);
}

double diagonal_of(int dimension, const std::vector<int>& tags, const std::string& name) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Vec3 lower = Vec3::Constant(none), upper = Vec3::Constant(-none);
  for (const int tag : tags) {
    Vec3 low, high;
    gmsh::model::getBoundingBox(dimension, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    lower = lower.cwiseMin(low);
    upper = upper.cwiseMax(high);
  }
  const double diagonal = (upper - lower).norm();
  require(std::isfinite(diagonal) && diagonal > 0, "the body has no extent", name, "give a closed body");
  return diagonal;
}

std::optional<std::int32_t>
vertex_of_point(int point, const std::unordered_map<std::size_t, std::int32_t>& vertex_of_node) {
  std::vector<std::size_t> nodes;
  std::vector<double> X, parameters;
  gmsh::model::mesh::getNodes(nodes, X, parameters, 0, point);
  if (nodes.empty())
    return {};
  const auto it = vertex_of_node.find(nodes[0]);
  if (it == vertex_of_node.end())
    return {};
  return it->second;
}

preprocess::CornerRule corner_rule(const std::vector<int>& curves,
                                   const std::unordered_map<std::size_t, std::int32_t>& vertex_of_node) {
  std::map<std::int32_t, std::vector<Vec3>> ends; // directions in which curves leave the CAD points
  for (const int point : tags_of(0))
    if (const auto v = vertex_of_point(point, vertex_of_node))
      ends[*v];
  for (const int curve : curves) {
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{1, curve}}, boundary, false, false);
    for (std::size_t end = 0; end < 2 && !boundary.empty(); ++end) {
      const auto v =
          vertex_of_point(std::abs(boundary[std::min(end, boundary.size() - 1)].second), vertex_of_node);
      const auto direction = direction_at_end(curve, end == 0);
      if (v && direction)
        ends[*v].push_back(*direction);
    }
  }
  preprocess::CornerRule rule;
  rule.candidate = [ends](std::int32_t v) { return ends.contains(v); };
  rule.kink = [ends](std::int32_t v) -> std::optional<double> {
    const auto& directions = ends.at(v);
    if (directions.size() != 2)
      return {};
    const Vec3 &a = directions[0], b = -directions[1];
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
  };
  rule.largest_kink = 10;
  return rule;
}

} // namespace tessera::importer
