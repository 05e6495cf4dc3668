#include "core/error.hpp"
#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/importer/bodies.hpp"
#include "preprocess/geometry/importer/gmsh_model.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"
#include "preprocess/geometry/importer/import_file.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace tessera::importer {
namespace {

using preprocess::Domain;

/// Node tags of tetrahedra, four each.
using Corners = std::vector<std::size_t>;

/// Pieces of the body that share no face, in the order of their first tetrahedra; they may touch at edges or
/// corners.
std::vector<Corners> pieces_of(const Corners& corners) {
  const std::size_t tets = corners.size() / 4;
  std::vector<std::size_t> parent(tets);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::size_t t) {
    while (parent[t] != t)
      t = parent[t] = parent[parent[t]];
    return t;
  };
  std::map<std::array<std::size_t, 3>, std::size_t> first;
  for (std::size_t t = 0; t < tets; ++t)
    for (int skip = 0; skip < 4; ++skip) {
      std::array<std::size_t, 3> key;
      for (int v = 0, k = 0; v < 4; ++v)
        if (v != skip)
          key[k++] = corners[4 * t + v];
      std::sort(key.begin(), key.end());
      const auto [it, added] = first.try_emplace(key, t);
      if (!added) {
        const std::size_t a = root(t), b = root(it->second);
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  std::map<std::size_t, Corners> pieces;
  for (std::size_t t = 0; t < tets; ++t) {
    auto& piece = pieces[root(t)];
    piece.insert(piece.end(), &corners[4 * t], &corners[4 * t] + 4);
  }
  std::vector<Corners> found;
  for (auto& [tet, piece] : pieces)
    found.push_back(std::move(piece));
  return found;
}

struct MeshBody {
  std::vector<int> volumes;
  Corners corners;
};

/// The body that is meant: all of the mesh when it hangs together; else one volume entity, or one piece where
/// there is but one entity.
MeshBody choose_mesh_body(const Request& request) {
  MeshBody all{tags_of(3), {}};
  std::vector<MeshBody> bodies;
  for (const int volume : all.volumes) {
    MeshBody body{{volume}, corners_of(volume)};
    all.corners.insert(all.corners.end(), body.corners.begin(), body.corners.end());
    if (!body.corners.empty())
      bodies.push_back(std::move(body));
  }
  const auto pieces = pieces_of(all.corners);
  if (request.solid == 0 && pieces.size() == 1)
    return all;
  if (bodies.size() == 1) {
    bodies.clear();
    for (const Corners& piece : pieces)
      bodies.push_back({all.volumes, piece});
  }
  constexpr std::size_t most_described = 8; // no message names more
  std::vector<Candidate> candidates(bodies.size());
  for (std::size_t b = 0; b < std::min(bodies.size(), most_described); ++b) {
    Domain domain = read_tetrahedra(bodies[b].volumes, bodies[b].corners, request.name, false).domain;
    domain.measure();
    candidates[b] = {{}, domain.volume, domain.lower, domain.upper};
  }
  const MeshBody& chosen = bodies[choose_body(candidates, request, "separate solid")];
  const std::size_t parts = pieces_of(chosen.corners).size();
  require(parts == 1, fmt::format("volume {} of the mesh falls into {} pieces", chosen.volumes[0], parts),
          request.name, "give each piece a volume of its own");
  return chosen;
}

} // namespace

Domain import_mesh(const Request& request) {
  open_file(request.file, request.name);
  require_first_order(3, request.name);
  const MeshBody body = choose_mesh_body(request);
  TaggedDomain tagged = read_tetrahedra(body.volumes, body.corners, request.name, false);
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
  }
  if (!topology)
    preprocess::find_feature_edges(domain, crease);
  preprocess::find_corners(domain, {});
  preprocess::chain_curves(domain);
  read_groups(tagged, body.volumes);
  domain.measure();
  domain.cad_volume = domain.volume;
  return std::move(domain);
}

} // namespace tessera::importer
