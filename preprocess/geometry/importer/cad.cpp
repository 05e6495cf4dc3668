#include "preprocess/geometry/importer/request.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/importer/gmsh_model.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace tessera::importer {
namespace {

using preprocess::Domain;

constexpr double first_segments = 24, most_segments = 4000; // edges a full turn
constexpr std::size_t most_triangles = 4'000'000;
constexpr double planar = 1e-12; // two tessellations closer than this are of a body with planar faces

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

/// Volume by the CAD kernel, when OpenCASCADE made the solid; gmsh's own kernel knows none.
std::optional<double> kernel_volume(int solid) {
  gmsh::vectorpair solids;
  gmsh::model::occ::getEntities(solids, 3);
  if (std::find(solids.begin(), solids.end(), std::pair{3, solid}) == solids.end())
    return {};
  double volume = 0;
  gmsh::model::occ::getMass(3, solid, volume);
  return std::abs(volume);
}

/// Meshes the surfaces with `segments` edges a turn; volume inside.
double mesh_surfaces(double size, double segments, bool by_curvature, const std::string& name) {
  gmsh::model::mesh::clear();
  const double finer = first_segments / segments;
  // gmsh's own kernel hangs in curvature sizing (4.8.4): its surfaces are refined all over.
  if (by_curvature)
    set_sizes(size, 0.1 * size * finer, segments);
  else
    set_sizes(size * finer, 0, 0);
  gmsh::model::mesh::generate(2);
  if (const std::string complaint = first_complaint(); !complaint.empty())
    throw InputError(fmt::format("a surface cannot be meshed: {}", complaint), name,
                     "heal the solid in the CAD program");
  const auto mesh = surface_triangles();
  require(mesh.triangles.size() < most_triangles,
          fmt::format("curved surfaces take more than {} triangles", most_triangles), name,
          "ask for a looser [geometry] tolerance");
  const double volume = volume_inside(mesh, name);
  require(volume > 0, "the solid has no volume", name, "give a closed solid");
  return volume;
}

struct Tessellation {
  double mesh_volume, cad_volume;
};

/// Refines the surfaces until the volume inside is right to the tolerance.
Tessellation tessellate(int solid, double size, const Request& request) {
  const std::optional<double> exact = kernel_volume(solid);
  double segments = first_segments, volume = mesh_surfaces(size, segments, exact.has_value(), request.name),
         error = 1;
  for (;;) {
    double limit = exact.value_or(0), next = 0;
    if (!exact) {
      // Chordal error falls with the square of the edge, so two meshes tell where it goes.
      const double coarser = volume;
      segments *= 2;
      volume = mesh_surfaces(size, segments, false, request.name);
      limit = std::abs(volume - coarser) < planar * volume ? volume : volume + (volume - coarser) / 3;
    }
    error = std::abs(volume - limit) / std::abs(limit);
    if (error < request.tolerance)
      return {volume, limit};
    if (segments >= most_segments)
      break;
    if (exact) {
      next = segments * std::clamp(1.05 * std::sqrt(error / request.tolerance), 1.2, 8.0);
      segments = std::min(std::ceil(next), most_segments);
      volume = mesh_surfaces(size, segments, true, request.name);
    }
  }
  throw InputError(
      fmt::format("the mesh volume stays {:.2g} off the CAD volume, more than the tolerance {:.2g}", error,
                  request.tolerance),
      request.name, "ask for a looser [geometry] tolerance or heal the solid");
}

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

/// CAD points, and the directions in which feature curves leave them.
std::map<std::int32_t, std::vector<Vec3>> curve_ends(const TaggedDomain& tagged) {
  std::map<std::int32_t, std::vector<Vec3>> ends;
  const auto vertex_of_point = [&](int point) -> std::optional<std::int32_t> {
    std::vector<std::size_t> nodes;
    std::vector<double> X, parameters;
    gmsh::model::mesh::getNodes(nodes, X, parameters, 0, point);
    if (nodes.empty())
      return {};
    const auto it = tagged.vertex_of_node.find(nodes[0]);
    if (it == tagged.vertex_of_node.end())
      return {};
    return it->second;
  };
  gmsh::vectorpair points;
  gmsh::model::getEntities(points, 0);
  for (const auto& point : points)
    if (const auto v = vertex_of_point(point.second))
      ends[*v];
  for (const auto& [curve, index] : tagged.curve_index) {
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{1, curve}}, boundary, false, false);
    for (std::size_t end = 0; end < 2 && !boundary.empty(); ++end) {
      const auto v = vertex_of_point(std::abs(boundary[std::min(end, boundary.size() - 1)].second));
      const auto direction = direction_at_end(curve, end == 0);
      if (v && direction)
        ends[*v].push_back(*direction);
    }
  }
  return ends;
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

/// One solid, or an InputError that says what there is instead.
int only_solid(const Request& request) {
  gmsh::vectorpair solids, surfaces;
  gmsh::model::getEntities(solids, 3);
  gmsh::model::getEntities(surfaces, 2);
  require(!solids.empty() || !surfaces.empty(), "there is no body in the file", request.name,
          "export a solid");
  require(!solids.empty(),
          fmt::format("there is no solid in the file, only {} surface{} without a volume", surfaces.size(),
                      surfaces.size() == 1 ? "" : "s"),
          request.name, "join them to a solid in the CAD program");
  require(solids.size() == 1, fmt::format("there are {} solids in the file", solids.size()), request.name,
          "unite them in the CAD program or give each body its own file");
  return solids[0].second;
}

} // namespace

Domain import_cad(const Request& request) {
  if (request.format == preprocess::CadFormat::step)
    gmsh::option::setString("Geometry.OCCTargetUnit", request.step_unit);
  open_file(request.file, request.name);
  const int solid = only_solid(request);
  gmsh::model::mesh::removeConstraints(); // transfinite and recombined surfaces of a .geo file
  gmsh::model::mesh::field::setAsBackgroundMesh(-1);
  first_complaint();

  double low[3], high[3];
  gmsh::model::getBoundingBox(3, solid, low[0], low[1], low[2], high[0], high[1], high[2]);
  const double diagonal = (Vec3(high[0], high[1], high[2]) - Vec3(low[0], low[1], low[2])).norm();
  require(std::isfinite(diagonal) && diagonal > 0, "the solid has no extent", request.name,
          "give a closed solid");
  const double size = request.mesh_size > 0 ? request.mesh_size : diagonal / 10;

  const Tessellation surface = tessellate(solid, size, request);
  fill_volume(size);
  if (const std::string complaint = first_complaint(); !complaint.empty())
    throw InputError(fmt::format("the volume cannot be meshed: {}", complaint), request.name,
                     "heal the solid in the CAD program");

  TaggedDomain tagged = read_tetrahedra(request.name, true);
  Domain& domain = tagged.domain;
  check_filled(domain, surface.mesh_volume, request.name);
  if (request.format == preprocess::CadFormat::step)
    name_step_faces(tagged, request);
  preprocess::find_feature_edges(domain);
  read_curves(tagged);
  preprocess::chain_curves(domain);

  const auto ends = curve_ends(tagged);
  preprocess::CornerRule rule;
  rule.candidate = [&](std::int32_t v) { return ends.contains(v); };
  rule.kink = [&](std::int32_t v) -> std::optional<double> {
    const auto& directions = ends.at(v);
    if (directions.size() != 2)
      return {};
    const Vec3 &a = directions[0], b = -directions[1];
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
  };
  rule.largest_kink = 10;
  preprocess::find_corners(domain, rule);
  read_groups(tagged);
  domain.cad_volume = surface.cad_volume;
  return std::move(domain);
}

} // namespace tessera::importer
