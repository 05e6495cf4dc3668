#include "preprocess/geometry/importer/gmsh_model.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/boundary.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tessera::importer {
namespace {

using preprocess::Domain;
using preprocess::Edge;
using preprocess::Triangle;

constexpr int line_type = 1, triangle_type = 2, tet_type = 4;

struct Elements {
  std::vector<std::size_t> tags, nodes;
};

Elements elements(int type, int entity) {
  Elements found;
  gmsh::model::mesh::getElementsByType(type, found.tags, found.nodes, entity);
  return found;
}

template <std::size_t N>
std::array<std::int32_t, N> sorted(std::array<std::int32_t, N> key) {
  std::sort(key.begin(), key.end());
  return key;
}

/// Surfaces that wall the body off: on its boundary, not embedded in it.
std::set<int> bounding_surfaces(const std::vector<int>& volumes) {
  gmsh::vectorpair solids, walls;
  for (const int volume : volumes)
    solids.emplace_back(3, volume);
  gmsh::model::getBoundary(solids, walls, true, false);
  std::set<int> tags;
  for (const auto& wall : walls)
    tags.insert(std::abs(wall.second));
  return tags;
}

/// Leaves out the tetrahedra that walls part from those at the outer boundary.
void drop_cavities(Domain& domain, const std::map<Triangle, int>& tag_of_triangle,
                   const std::set<int>& walls) {
  const auto tets = domain.tets.size();
  std::map<Triangle, std::int32_t> first; // face without a wall in it, by the first of its two tetrahedra
  std::vector<std::vector<std::int32_t>> next(tets);
  std::vector<char> reached(tets, 0);
  std::vector<std::int32_t> waiting;
  for (const auto& facet : preprocess::boundary_of(domain.tets))
    if (!reached[facet.tet]) {
      reached[facet.tet] = 1;
      waiting.push_back(facet.tet);
    }
  for (std::size_t t = 0; t < tets; ++t)
    for (const auto& face : preprocess::tet_faces) {
      const Triangle key =
          sorted(Triangle{domain.tets[t][face[0]], domain.tets[t][face[1]], domain.tets[t][face[2]]});
      if (const auto it = tag_of_triangle.find(key);
          it != tag_of_triangle.end() && walls.contains(it->second))
        continue;
      const auto [it, added] = first.try_emplace(key, static_cast<std::int32_t>(t));
      if (added)
        continue;
      next[t].push_back(it->second);
      next[it->second].push_back(static_cast<std::int32_t>(t));
    }
  while (!waiting.empty()) {
    const std::int32_t t = waiting.back();
    waiting.pop_back();
    for (const std::int32_t n : next[t])
      if (!reached[n]) {
        reached[n] = 1;
        waiting.push_back(n);
      }
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < tets; ++t)
    if (reached[t])
      domain.tets[kept++] = domain.tets[t];
  domain.tets.resize(kept);
}

} // namespace

preprocess::Triangles surface_triangles() {
  preprocess::Triangles surface;
  std::vector<std::size_t> nodes;
  std::vector<double> X, parameters;
  gmsh::model::mesh::getNodes(nodes, X, parameters);
  std::unordered_map<std::size_t, std::int32_t> vertex_of_node;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (vertex_of_node.try_emplace(nodes[n], static_cast<std::int32_t>(surface.vertices.size())).second)
      surface.vertices.emplace_back(X[3 * n], X[3 * n + 1], X[3 * n + 2]);
  for (const int tag : tags_of(2)) {
    const auto found = elements(triangle_type, tag);
    for (std::size_t n = 0; n + 2 < found.nodes.size(); n += 3)
      surface.triangles.push_back({vertex_of_node.at(found.nodes[n]), vertex_of_node.at(found.nodes[n + 1]),
                                   vertex_of_node.at(found.nodes[n + 2])});
  }
  return surface;
}

std::vector<std::size_t> corners_of(int volume) {
  return elements(tet_type, volume).nodes;
}

TaggedDomain read_tetrahedra(const std::vector<int>& volumes, const std::vector<std::size_t>& corners,
                             const std::string& name, bool need_surfaces) {
  TaggedDomain tagged;
  Domain& domain = tagged.domain;
  std::vector<std::size_t> nodes;
  std::vector<double> X, parameters;
  gmsh::model::mesh::getNodes(nodes, X, parameters);
  std::map<std::size_t, std::size_t> place; // in order of the nodes' tags, whatever gmsh's own order
  for (std::size_t n = 0; n < nodes.size(); ++n)
    place.try_emplace(nodes[n], n);

  const std::set<std::size_t> used(corners.begin(), corners.end());
  for (const auto& [node, n] : place) {
    if (!used.contains(node))
      continue;
    tagged.vertex_of_node[node] = static_cast<std::int32_t>(domain.vertices.size());
    domain.vertices.emplace_back(X[3 * n], X[3 * n + 1], X[3 * n + 2]);
  }
  for (std::size_t c = 0; c + 3 < corners.size(); c += 4) {
    std::array<std::int32_t, 4> tet;
    for (int v = 0; v < 4; ++v) {
      const auto it = tagged.vertex_of_node.find(corners[c + v]);
      require(it != tagged.vertex_of_node.end(), "a tetrahedron names a node that is not there", name,
              "repair the mesh");
      tet[v] = it->second;
    }
    domain.tets.push_back(tet);
    if (domain.tet_volume(domain.tets.size() - 1) < 0)
      std::swap(domain.tets.back()[2], domain.tets.back()[3]);
  }
  std::map<Triangle, int> tag_of_triangle;
  for (const int tag : tags_of(2)) {
    const auto found = elements(triangle_type, tag);
    for (std::size_t n = 0; n + 2 < found.nodes.size(); n += 3) {
      Triangle key;
      bool known = true;
      for (int v = 0; v < 3; ++v) {
        const auto it = tagged.vertex_of_node.find(found.nodes[n + v]);
        known = known && it != tagged.vertex_of_node.end();
        if (known)
          key[v] = it->second;
      }
      if (known)
        tag_of_triangle.try_emplace(sorted(key), tag);
    }
  }
  drop_cavities(domain, tag_of_triangle, bounding_surfaces(volumes));
  domain.facets = preprocess::boundary_of(domain.tets);
  std::vector<int> tags(domain.facets.size(), -1);
  for (std::size_t f = 0; f < tags.size(); ++f) {
    const auto it = tag_of_triangle.find(sorted(domain.facets[f].vertices));
    if (it != tag_of_triangle.end())
      tags[f] = it->second;
    require(it != tag_of_triangle.end() || !need_surfaces,
            "a boundary face of the volume mesh lies on no surface", name,
            "repair the body: its surfaces may intersect");
  }
  const std::set<int> bounding(tags.begin(), tags.end());
  std::map<int, std::int32_t> index;
  for (const int tag : bounding)
    if (tag >= 0) {
      index[tag] = static_cast<std::int32_t>(domain.surfaces.size());
      domain.surfaces.push_back(fmt::format("face{}", tag));
      tagged.surface_tags.push_back(tag);
    }
  for (std::size_t f = 0; f < tags.size(); ++f)
    if (tags[f] >= 0)
      domain.facets[f].surface = index.at(tags[f]);
  return tagged;
}

void check_filled(Domain& domain, double surface_volume, const std::string& name) {
  domain.measure();
  require(std::abs(domain.volume - surface_volume) <= 1e-9 * surface_volume,
          fmt::format("the tetrahedra fill {:.9g} of the {:.9g} inside the surface", domain.volume,
                      surface_volume),
          name, "heal the solid in the CAD program");
}

void read_curves(TaggedDomain& tagged) {
  std::map<Edge, int> tag_of_edge;
  for (const int tag : tags_of(1)) {
    const auto found = elements(line_type, tag);
    for (std::size_t n = 0; n + 1 < found.nodes.size(); n += 2) {
      const auto a = tagged.vertex_of_node.find(found.nodes[n]),
                 b = tagged.vertex_of_node.find(found.nodes[n + 1]);
      if (a != tagged.vertex_of_node.end() && b != tagged.vertex_of_node.end())
        tag_of_edge.try_emplace(sorted(Edge{a->second, b->second}), tag);
    }
  }
  std::set<int> features;
  for (const auto& edge : tagged.domain.feature_edges)
    if (const auto it = tag_of_edge.find(edge.vertices); it != tag_of_edge.end())
      features.insert(it->second);
  for (const int tag : features)
    tagged.curve_index.try_emplace(tag, static_cast<std::int32_t>(tagged.curve_index.size()));
  for (auto& edge : tagged.domain.feature_edges)
    if (const auto it = tag_of_edge.find(edge.vertices); it != tag_of_edge.end())
      edge.curve = tagged.curve_index.at(it->second);
}

void read_groups(TaggedDomain& tagged, const std::vector<int>& volumes) {
  const bool others = tags_of(3).size() > volumes.size();
  for (const auto& [dimension, name, entities] : physical_groups()) {
    Domain::Group group;
    group.dimension = dimension;
    group.name = name;
    bool of_body = false;
    for (const int tag : entities) {
      of_body = of_body || (dimension == 3 && std::count(volumes.begin(), volumes.end(), tag) > 0);
      if (dimension == 2) {
        const auto it = std::find(tagged.surface_tags.begin(), tagged.surface_tags.end(), tag);
        if (it != tagged.surface_tags.end())
          group.surfaces.push_back(static_cast<std::int32_t>(it - tagged.surface_tags.begin()));
      } else if (dimension == 1) {
        if (const auto it = tagged.curve_index.find(tag); it != tagged.curve_index.end())
          group.curves.push_back(it->second);
      } else if (dimension == 0) {
        std::vector<std::size_t> nodes;
        std::vector<double> X, parameters;
        gmsh::model::mesh::getNodes(nodes, X, parameters, 0, tag);
        for (const std::size_t node : nodes)
          if (const auto it = tagged.vertex_of_node.find(node); it != tagged.vertex_of_node.end())
            group.vertices.push_back(it->second);
      }
    }
    of_body = of_body || !group.surfaces.empty() || !group.curves.empty() || !group.vertices.empty();
    if (of_body || !others)
      tagged.domain.groups.push_back(std::move(group));
  }
}

} // namespace tessera::importer
