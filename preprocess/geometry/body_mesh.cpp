#include "preprocess/geometry/body_mesh.hpp"

namespace tessera::preprocess {
namespace {

/// The upper lid, its vertices numbered anew.
BodyMesh lid_of(const Domain& slab) {
  BodyMesh mesh;
  mesh.dimension = 2;
  std::vector<std::int32_t> place(slab.vertices.size(), -1);
  const auto placed = [&](std::int32_t v) {
    if (place[v] < 0) {
      place[v] = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.emplace_back(slab.vertices[v].x(), slab.vertices[v].y(), 0);
    }
    return place[v];
  };
  for (const Domain::Facet& facet : slab.facets)
    if (const auto& v = facet.vertices; facet.surface == Domain::lid && slab.vertices[v[0]].z() > 0)
      mesh.faces.push_back({placed(v[0]), placed(v[1]), placed(v[2])});
  for (const Domain::FeatureEdge& edge : slab.feature_edges)
    mesh.edges.push_back({placed(edge.vertices[0]), placed(edge.vertices[1])});
  return mesh;
}

} // namespace

BodyMesh body_mesh(const Domain& domain) {
  if (domain.dimension == 2)
    return lid_of(domain);
  BodyMesh mesh{3, domain.vertices, domain.tets, {}, {}};
  for (const Domain::Facet& facet : domain.facets)
    mesh.faces.push_back(facet.vertices);
  for (const Domain::FeatureEdge& edge : domain.feature_edges)
    mesh.edges.push_back(edge.vertices);
  return mesh;
}

} // namespace tessera::preprocess
