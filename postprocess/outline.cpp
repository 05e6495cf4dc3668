#include "postprocess/outline.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace tessera::post {
namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge_of(std::int32_t a, std::int32_t b) {
  return std::minmax(a, b);
}

/// Twice the area vector of a polygon.
Vec3 area_of(const std::vector<Vec3>& points, const CutBody::Polygon& polygon) {
  Vec3 area = Vec3::Zero();
  for (std::size_t k = 2; k < polygon.size(); ++k)
    area += (points[polygon[k - 1]] - points[polygon[0]]).cross(points[polygon[k]] - points[polygon[0]]);
  return area;
}

struct Sides {
  int towards = 0, away = 0; ///< faces beside an edge
};

} // namespace

std::vector<std::array<Vec3, 2>> outline_of(const CutBody& body, const Vec3& into) {
  constexpr double edge_on = 1e-6; // sine of the angle under which a face counts as turned away
  std::map<Edge, Sides> sides;
  for (const CutBody::Polygon& polygon : body.skin) {
    const Vec3 area = area_of(body.points, polygon);
    const bool towards = area.dot(into) < -edge_on * area.norm();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      Sides& beside = sides[edge_of(polygon[k], polygon[(k + 1) % polygon.size()])];
      ++(towards ? beside.towards : beside.away);
    }
  }
  std::vector<std::array<Vec3, 2>> lines;
  const auto add = [&](std::int32_t a, std::int32_t b) { lines.push_back({body.points[a], body.points[b]}); };
  for (const auto& [a, b] : body.edges) {
    const auto beside = sides.find(edge_of(a, b));
    if (beside == sides.end() || beside->second.towards > 0)
      add(a, b);
  }
  for (const auto& [a, b] : body.edges) // not twice
    sides.erase(edge_of(a, b));
  for (const auto& [edge, beside] : sides)
    if (beside.towards > 0 && beside.away > 0)
      add(edge.first, edge.second);
  for (const auto& [a, b] : body.rim)
    add(a, b);
  return lines;
}

} // namespace tessera::post
