#include "core/error.hpp"
#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/importer/gmsh_model.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"
#include "preprocess/geometry/importer/import_file.hpp"
#include "preprocess/geometry/importer/triangle_surface.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <set>

namespace tessera::importer {

preprocess::Domain import_surface(const Request& request) {
  const auto surface = closed_surface(read_surface(request), request);

  // Each shell is a discrete surface of its own; the volume lies between them.
  gmsh::model::add("surface");
  const auto shells = preprocess::shells_of(surface.triangles);
  Vec3 low = surface.vertices[0], high = low;
  for (const Vec3& X : surface.vertices) {
    low = low.cwiseMin(X);
    high = high.cwiseMax(X);
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
    const std::set<std::size_t> own(corners.begin(), corners.end());
    std::vector<double> X;
    for (const std::size_t node : own)
      X.insert(X.end(), surface.vertices[node - 1].data(), surface.vertices[node - 1].data() + 3);
    gmsh::model::mesh::addNodes(2, shell + 1, {own.begin(), own.end()}, X);
    gmsh::model::mesh::addElementsByType(shell + 1, 2, {}, corners);
    loops.push_back(gmsh::model::geo::addSurfaceLoop({shell + 1}));
  }
  gmsh::model::geo::addVolume(loops);
  gmsh::model::geo::synchronize();
  first_complaint();
  const double size = request.mesh_size > 0 ? request.mesh_size : (high - low).norm() / 10;
  fill_volume({.largest = size, .extend = false}, {}, request.name);
  if (const std::string complaint = first_complaint(); !complaint.empty())
    throw InputError(fmt::format("the volume inside the surface cannot be meshed: {}", complaint),
                     request.name, "remesh the surface in the program it comes from");

  preprocess::Domain domain =
      read_tetrahedra(tags_of(3), corners_of(tags_of(3).at(0)), request.name, true).domain;
  preprocess::surfaces_by_angle(domain, crease);
  preprocess::find_feature_edges(domain, crease);
  preprocess::find_corners(domain, {});
  preprocess::chain_curves(domain);
  domain.measure();
  domain.cad_volume = domain.volume;
  return domain;
}

} // namespace tessera::importer
