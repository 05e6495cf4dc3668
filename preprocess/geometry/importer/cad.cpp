#include "preprocess/geometry/importer/import_file.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/cad_file.hpp"
#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/importer/bodies.hpp"
#include "preprocess/geometry/importer/cad_model.hpp"
#include "preprocess/geometry/importer/gmsh_model.hpp"
#include "preprocess/geometry/importer/shapes.hpp"
#include "preprocess/geometry/importer/tessellate.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>

namespace tessera::importer {
namespace {

using preprocess::Domain;

/// Volume inside the surface mesh: the outer shell less the cavities.
double volume_inside(const preprocess::Triangles& mesh, const std::string& name) {
  auto triangles = mesh.triangles;
  const auto unpaired = preprocess::unpaired_edges(triangles);
  if (!unpaired.empty()) {
    const Vec3 X = (mesh.vertices[unpaired[0][0]] + mesh.vertices[unpaired[0][1]]) / 2;
    throw InputError(
        fmt::format("the surface of the solid is open or not manifold: {} mesh edges without exactly two "
                    "triangles, the first near ({:.6g}, {:.6g}, {:.6g}) in the file's unit",
                    unpaired.size(), X[0], X[1], X[2]),
        name, "heal the solid in the CAD program");
  }
  require(preprocess::orient(triangles), "the surface of the solid has only one side", name,
          "heal the solid in the CAD program");
  auto volumes = preprocess::shell_volumes(mesh.vertices, triangles, preprocess::shells_of(triangles));
  for (double& volume : volumes)
    volume = std::abs(volume);
  std::sort(volumes.begin(), volumes.end(), std::greater<>());
  double inside = volumes.empty() ? 0 : volumes[0];
  for (std::size_t s = 1; s < volumes.size(); ++s)
    inside -= volumes[s];
  return inside;
}

/// Names of the faces in a STEP file go with gmsh's numbers, both in the order of the shell.
void name_step_faces(TaggedDomain& tagged, const Request& request) {
  const auto names = preprocess::step_face_names(preprocess::read_text(request.file));
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  if (names.size() != surfaces.size())
    return;
  for (std::size_t s = 0; s < tagged.surface_tags.size(); ++s) {
    const auto at = static_cast<std::size_t>(tagged.surface_tags[s] - 1);
    if (at < names.size() && !names[at].empty())
      tagged.domain.surfaces[s] = names[at];
  }
}

} // namespace

Domain import_cad(const Request& request) {
  open_cad(request);
  const int solid = choose_solid(request);
  const FileSizes file_sizes = sizes_in_file();
  gmsh::model::mesh::removeConstraints(); // transfinite and recombined surfaces of a .geo file
  if (!request.background_sizes)
    gmsh::model::mesh::field::setAsBackgroundMesh(-1);
  first_complaint();

  const double diagonal = diagonal_of(3, {solid}, request.name);
  const double size = request.mesh_size > 0      ? request.mesh_size
                      : request.background_sizes ? diagonal
                                                 : diagonal / 10;
  const Tessellation surface = tessellate(kernel_measure(3, solid), size, file_sizes, request,
                                          [&] { return volume_inside(surface_triangles(), request.name); });
  fill_volume(request.background_sizes ? surface.sizes : Sizes{.largest = size, .extend = false}, file_sizes,
              request.name);
  if (const std::string complaint = first_complaint(); !complaint.empty())
    throw InputError(fmt::format("the volume cannot be meshed: {}", complaint), request.name,
                     "heal the solid in the CAD program");

  TaggedDomain tagged = read_tetrahedra({solid}, corners_of(solid), request.name, true);
  Domain& domain = tagged.domain;
  check_filled(domain, surface.mesh_measure, request.name);
  if (request.shape)
    domain.surfaces = shape_names(*request.shape, 3, tagged.surface_tags);
  else if (preprocess::check_cad_file(request.file) == preprocess::CadFormat::step)
    name_step_faces(tagged, request);
  preprocess::find_feature_edges(domain);
  read_curves(tagged);
  preprocess::chain_curves(domain);
  std::vector<int> curves;
  for (const auto& curve : tagged.curve_index)
    curves.push_back(curve.first);
  preprocess::find_corners(domain, corner_rule(curves, tagged.vertex_of_node));
  read_groups(tagged, {solid});
  domain.cad_volume = surface.cad_measure;
  return std::move(domain);
}

} // namespace tessera::importer
