#include "preprocess/geometry/importer/plane_model.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/importer/cad_model.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <map>
#include <set>

namespace tessera::importer {
namespace {

using preprocess::Domain;
using preprocess::Edge;

constexpr int line_type = 1, triangle_type = 2;

/// Throws unless all heights agree; says which surface leaves the plane.
void check_plane(const std::map<int, std::array<double, 2>>& heights, double diagonal,
                 const Request& request) {
  const auto [low, high] = heights.begin()->second;
  for (const auto& [surface, range] : heights) {
    require(range[1] - range[0] <= flat * diagonal, not_plane(surface, heights.size(), range[0], range[1]),
            request.name, plane_remedy);
    require(range[1] - low <= flat * diagonal && high - range[0] <= flat * diagonal,
            fmt::format("the plane surfaces lie in different planes: surface {} in z = {:.6g}, surface {} in "
                        "z = {:.6g}",
                        heights.begin()->first, low, surface, range[0]),
            request.name, plane_remedy);
  }
}

} // namespace

std::string not_plane(int surface, std::size_t count, double low, double high) {
  return fmt::format(
      "surface {} of {} does not lie in a plane z = const: it reaches from z = {:.6g} to {:.6g}", surface,
      count, low, high);
}

TaggedFigure read_triangles(const std::vector<int>& surfaces, const Request& request) {
  TaggedFigure tagged;
  std::vector<std::size_t> nodes, corners;
  std::vector<double> X, parameters;
  gmsh::model::mesh::getNodes(nodes, X, parameters);
  std::map<std::size_t, std::size_t> place; // in order of the nodes' tags, whatever gmsh's own order
  for (std::size_t n = 0; n < nodes.size(); ++n)
    place.try_emplace(nodes[n], n);

  std::set<std::size_t> used;
  std::map<int, std::array<double, 2>> heights;
  for (const int tag : surfaces.empty() ? tags_of(2) : surfaces) {
    std::vector<std::size_t> tags, found;
    gmsh::model::mesh::getElementsByType(triangle_type, tags, found, tag);
    for (const std::size_t node : found) {
      const auto it = place.find(node);
      require(it != place.end(), "a triangle names a node that is not there", request.name,
              "repair the mesh");
      const double z = X[3 * it->second + 2];
      auto& range = heights.try_emplace(tag, std::array{z, z}).first->second;
      range = {std::min(range[0], z), std::max(range[1], z)};
    }
    corners.insert(corners.end(), found.begin(), found.end());
    used.insert(found.begin(), found.end());
  }
  require(!corners.empty(), "the plane figure has no triangles", request.name, "mesh its surfaces");

  auto& figure = tagged.figure;
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const std::size_t node : used) {
    const Vec3 P(&X[3 * place.at(node)]);
    require(P.allFinite(), "a node of the mesh is not a finite point", request.name, "repair the mesh");
    tagged.vertex_of_node[node] = static_cast<std::int32_t>(figure.vertices.size());
    figure.vertices.emplace_back(P[0], P[1]);
    lower = lower.cwiseMin(P);
    upper = upper.cwiseMax(P);
  }
  check_plane(heights, (upper - lower).norm(), request);
  tagged.z = heights.begin()->second[0];
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3)
    figure.triangles.push_back({tagged.vertex_of_node.at(corners[c]),
                                tagged.vertex_of_node.at(corners[c + 1]),
                                tagged.vertex_of_node.at(corners[c + 2])});
  return tagged;
}

bool read_sides(TaggedFigure& tagged, const Request& request) {
  auto& figure = tagged.figure;
  preprocess::find_sides(figure, request.name);
  std::map<Edge, int> tag_of_edge;
  for (const int tag : tags_of(1)) {
    std::vector<std::size_t> tags, found;
    gmsh::model::mesh::getElementsByType(line_type, tags, found, tag);
    for (std::size_t n = 0; n + 1 < found.size(); n += 2) {
      const auto a = tagged.vertex_of_node.find(found[n]), b = tagged.vertex_of_node.find(found[n + 1]);
      if (a != tagged.vertex_of_node.end() && b != tagged.vertex_of_node.end())
        tag_of_edge.try_emplace({std::min(a->second, b->second), std::max(a->second, b->second)}, tag);
    }
  }
  const auto tag_of = [&](const preprocess::PlaneFigure::Side& side) {
    const auto [a, b] = std::minmax(side.vertices[0], side.vertices[1]);
    const auto it = tag_of_edge.find({a, b});
    return it == tag_of_edge.end() ? -1 : it->second;
  };
  std::map<int, std::int32_t> index;
  for (const auto& side : figure.sides)
    index[tag_of(side)] = -1;
  const bool complete = index.erase(-1) == 0;
  for (auto& [tag, curve] : index) {
    curve = static_cast<std::int32_t>(figure.curves.size());
    figure.curves.push_back(fmt::format("edge{}", tag));
    tagged.curve_tags.push_back(tag);
  }
  for (auto& side : figure.sides)
    if (const int tag = tag_of(side); tag >= 0)
      side.curve = index.at(tag);
  return complete;
}

void read_plane_groups(const TaggedFigure& tagged, const std::vector<int>& surfaces, Domain& domain) {
  const bool others = tags_of(2).size() > surfaces.size();
  for (const auto& [dimension, name, entities] : physical_groups()) {
    if (dimension > 2)
      continue;
    Domain::Group group;
    group.dimension = dimension == 0 ? 0 : dimension + 1;
    group.name = name;
    bool of_body = false;
    for (const int tag : entities) {
      if (dimension == 2) {
        of_body = of_body || std::count(surfaces.begin(), surfaces.end(), tag) > 0;
      } else if (dimension == 1) {
        const auto it = std::find(tagged.curve_tags.begin(), tagged.curve_tags.end(), tag);
        if (it != tagged.curve_tags.end())
          group.surfaces.push_back(static_cast<std::int32_t>(it - tagged.curve_tags.begin()));
      } else if (const auto v = vertex_of_point(tag, tagged.vertex_of_node)) {
        group.vertices.push_back(*v);
      }
    }
    if (of_body || !group.surfaces.empty() || !group.vertices.empty() || !others)
      domain.groups.push_back(std::move(group));
  }
}

} // namespace tessera::importer
