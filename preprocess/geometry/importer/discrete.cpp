#include "core/error.hpp"
#include "preprocess/geometry/cad_file.hpp"
#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/importer/gmsh_model.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"
#include "preprocess/geometry/importer/import_file.hpp"
#include "preprocess/geometry/stl.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <set>

namespace tessera::importer {
namespace {

using preprocess::Domain;

constexpr double crease =
    40; // degrees: bodies that come without a CAD's surfaces are cut along sharper edges

/// Pieces of the body that share no face; facets of one piece may touch another's only at edges or corners.
std::size_t pieces(const Domain& domain) {
  std::vector<std::int32_t> parent(domain.tets.size());
  for (std::size_t t = 0; t < parent.size(); ++t)
    parent[t] = static_cast<std::int32_t>(t);
  const auto root = [&](std::int32_t t) {
    while (parent[t] != t)
      t = parent[t] = parent[parent[t]];
    return t;
  };
  std::map<preprocess::Triangle, std::int32_t> first;
  for (std::size_t t = 0; t < domain.tets.size(); ++t)
    for (int skip = 0; skip < 4; ++skip) {
      preprocess::Triangle key;
      for (int v = 0, k = 0; v < 4; ++v)
        if (v != skip)
          key[k++] = domain.tets[t][v];
      std::sort(key.begin(), key.end());
      const auto [it, added] = first.try_emplace(key, static_cast<std::int32_t>(t));
      if (!added)
        parent[root(static_cast<std::int32_t>(t))] = root(it->second);
    }
  std::size_t count = 0;
  for (std::size_t t = 0; t < parent.size(); ++t)
    count += parent[t] == static_cast<std::int32_t>(t);
  return count;
}

/// Volume of a body that is its own reference; one piece only.
void finish(TaggedDomain& tagged, const std::string& name) {
  Domain& domain = tagged.domain;
  domain.measure();
  domain.cad_volume = domain.volume;
  const std::size_t count = pieces(domain);
  require(count == 1, fmt::format("the mesh falls into {} separate bodies", count), name,
          "give each body its own file");
}

void refuse_other_elements(const std::string& name) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  for (const int type : types)
    if (type != 4) {
      std::string kind;
      int dimension, order, nodes, primary;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(type, kind, dimension, order, nodes, local, primary);
      throw InputError(
          fmt::format("the mesh has elements of type {}; only four-node tetrahedra are read", kind), name,
          "save it with first-order tetrahedra");
    }
  require(!types.empty(), "there are no tetrahedra in the mesh", name,
          "mesh the volume, not only the surface");
}

} // namespace

Domain import_mesh(const Request& request) {
  open_file(request.file, request.name);
  refuse_other_elements(request.name);
  TaggedDomain tagged = read_tetrahedra(tags_of(3), request.name, false);
  Domain& domain = tagged.domain;

  const auto bare = [](const Domain::Facet& facet) { return facet.surface < 0; };
  const bool any_bare = std::any_of(domain.facets.begin(), domain.facets.end(), bare);
  const bool all_bare = std::all_of(domain.facets.begin(), domain.facets.end(), bare);
  require(all_bare || !any_bare,
          "some boundary faces of the mesh lie on a surface of the file and some on none", request.name,
          "save all its surfaces or none");
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  const bool topology = domain.surfaces.size() > 1 || (!all_bare && !curves.empty());
  if (topology) {
    preprocess::find_feature_edges(domain);
    read_curves(tagged);
  } else if (all_bare) {
    tagged.surface_tags.clear();
    preprocess::surfaces_by_angle(domain, crease);
    preprocess::find_feature_edges(domain, crease);
  } else {
    preprocess::find_feature_edges(domain, crease);
  }
  preprocess::find_corners(domain, {});
  preprocess::chain_curves(domain);
  read_groups(tagged, tags_of(3));
  finish(tagged, request.name);
  return std::move(domain);
}

Domain import_stl(const Request& request) {
  auto surface = preprocess::read_stl(preprocess::read_text(request.file), request.name);
  preprocess::close_and_orient(surface, request.name);

  // Each shell is a discrete surface of its own; the volume lies between them.
  gmsh::model::add("stl");
  const auto shells = preprocess::shells_of(surface.triangles);
  std::vector<std::size_t> nodes;
  std::vector<double> X;
  Vec3 low = surface.vertices[0], high = low;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    nodes.push_back(v + 1);
    X.insert(X.end(), surface.vertices[v].data(), surface.vertices[v].data() + 3);
    low = low.cwiseMin(surface.vertices[v]);
    high = high.cwiseMax(surface.vertices[v]);
  }
  const int count = *std::max_element(shells.begin(), shells.end()) + 1;
  std::vector<int> loops;
  for (int shell = 0; shell < count; ++shell) {
    std::vector<std::size_t> corners;
    for (std::size_t t = 0; t < shells.size(); ++t)
      if (shells[t] == shell)
        for (const std::int32_t v : surface.triangles[t])
          corners.push_back(static_cast<std::size_t>(v) + 1);
    gmsh::model::addDiscreteEntity(2, shell + 1);
    std::set<std::size_t> own(corners.begin(), corners.end());
    std::vector<double> own_X;
    for (const std::size_t node : own)
      own_X.insert(own_X.end(), &X[3 * (node - 1)], &X[3 * (node - 1)] + 3);
    gmsh::model::mesh::addNodes(2, shell + 1, {own.begin(), own.end()}, own_X);
    gmsh::model::mesh::addElementsByType(shell + 1, 2, {}, corners);
    loops.push_back(gmsh::model::geo::addSurfaceLoop({shell + 1}));
  }
  gmsh::model::geo::addVolume(loops);
  gmsh::model::geo::synchronize();
  first_complaint();
  fill_volume(
      {.largest = request.mesh_size > 0 ? request.mesh_size : (high - low).norm() / 10, .extend = false}, {},
      request.name);
  if (const std::string complaint = first_complaint(); !complaint.empty())
    throw InputError(fmt::format("the volume inside the surface cannot be meshed: {}", complaint),
                     request.name, "repair the surface: it may intersect itself");

  TaggedDomain tagged = read_tetrahedra(tags_of(3), request.name, true);
  Domain& domain = tagged.domain;
  preprocess::surfaces_by_angle(domain, crease);
  preprocess::find_feature_edges(domain, crease);
  preprocess::find_corners(domain, {});
  preprocess::chain_curves(domain);
  finish(tagged, request.name);
  return std::move(domain);
}

} // namespace tessera::importer
