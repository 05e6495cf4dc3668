#include "core/error.hpp"
#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/importer/bodies.hpp"
#include "preprocess/geometry/importer/cad_model.hpp"
#include "preprocess/geometry/importer/glue.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"
#include "preprocess/geometry/importer/import_file.hpp"
#include "preprocess/geometry/importer/plane_model.hpp"
#include "preprocess/geometry/importer/shapes.hpp"
#include "preprocess/geometry/importer/tessellate.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tessera::importer {
namespace {

using preprocess::Domain;
using preprocess::PlaneFigure;

constexpr double crease = 40; // degrees: figures that come without a CAD's curves are cut at sharper kinks

double area_of(const PlaneFigure& figure) {
  double area = 0;
  for (const auto& [a, b, c] : figure.triangles) {
    const Vec<2> u = figure.vertices[b] - figure.vertices[a], v = figure.vertices[c] - figure.vertices[a];
    area += std::abs(u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return area;
}

/// Refuses surfaces that are clearly in no plane z = const before anything is joined or meshed.
void check_flat(const Request& request) {
  constexpr double padding = 1e-6; // OpenCASCADE widens its boxes by its tolerance
  const auto surfaces = tags_of(2);
  for (const int surface : surfaces) {
    Vec3 low, high;
    gmsh::model::getBoundingBox(2, surface, low[0], low[1], low[2], high[0], high[1], high[2]);
    for (double* z : {&low[2], &high[2]})
      *z = std::round(*z / padding) * padding + 0.0; // a zero without sign
    require(high[2] - low[2] <= flat * (high - low).norm() + padding,
            not_plane(surface, surfaces.size(), low[2], high[2]), request.name, plane_remedy);
  }
}

/// Surfaces of the body that is meant: those that hang together, glued first where they only touch.
std::vector<int> choose_figure(const Request& request) {
  const std::size_t solids = tags_of(3).size();
  require(solids == 0,
          fmt::format("the file holds {} solid{}, not a plane figure", solids, solids == 1 ? "" : "s"),
          request.name, "set [geometry] dimension = 3, or draw plane surfaces only");
  require(!tags_of(2).empty(),
          fmt::format("there is no plane surface in the file, only {} curves", tags_of(1).size()),
          request.name, "make a surface of them");
  check_flat(request);
  auto figures = connected_surfaces();
  if (figures.size() > 1) {
    glue_surfaces();
    if (const std::string complaint = first_complaint(); !complaint.empty())
      throw InputError(fmt::format("surfaces that touch cannot be joined: {}", complaint), request.name,
                       "unite them in the CAD program");
    figures = connected_surfaces();
  }
  std::vector<Candidate> candidates;
  for (const auto& surfaces : figures) {
    Candidate body{{}, 0, Vec3::Constant(std::numeric_limits<double>::infinity()), {}};
    body.upper = -body.lower;
    for (const int surface : surfaces) {
      Vec3 low, high;
      gmsh::model::getBoundingBox(2, surface, low[0], low[1], low[2], high[0], high[1], high[2]);
      body.lower = body.lower.cwiseMin(low);
      body.upper = body.upper.cwiseMax(high);
      body.measure += kernel_measure(2, surface).value_or(std::nan(""));
    }
    candidates.push_back(body);
  }
  return figures[choose_body(candidates, request, "separate plane figure")];
}

/// Area by the CAD kernel, where it knows all the surfaces'.
std::optional<double> kernel_area(const std::vector<int>& surfaces) {
  double sum = 0;
  for (const int surface : surfaces) {
    const auto area = kernel_measure(2, surface);
    if (!area)
      return {};
    sum += *area;
  }
  return sum;
}

/// Keeps the piece of a plane mesh that is meant.
void choose_piece(TaggedFigure& tagged, const Request& request) {
  auto& figure = tagged.figure;
  const auto piece = preprocess::shells_of(figure.triangles);
  const int count = *std::max_element(piece.begin(), piece.end()) + 1;
  if (count == 1 && request.solid <= 1)
    return;
  std::vector<PlaneFigure> parts(count);
  std::vector<Candidate> candidates;
  for (std::size_t t = 0; t < piece.size(); ++t)
    parts[piece[t]].triangles.push_back(figure.triangles[t]);
  for (PlaneFigure& part : parts) {
    part.vertices = figure.vertices;
    Candidate body{{}, area_of(part), Vec3::Constant(std::numeric_limits<double>::infinity()), {}};
    body.upper = -body.lower;
    for (const auto& t : part.triangles)
      for (const std::int32_t v : t) {
        const Vec3 X(figure.vertices[v][0], figure.vertices[v][1], tagged.z);
        body.lower = body.lower.cwiseMin(X);
        body.upper = body.upper.cwiseMax(X);
      }
    candidates.push_back(body);
  }
  const auto& kept = parts[choose_body(candidates, request, "separate plane figure")].triangles;
  std::map<std::int32_t, std::int32_t> number; // ascending, so that vertices keep their order
  for (const auto& t : kept)
    for (const std::int32_t v : t)
      number[v] = 0;
  std::vector<Vec<2>> vertices;
  for (auto& [old, now] : number) {
    now = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(figure.vertices[old]);
  }
  std::erase_if(tagged.vertex_of_node, [&](const auto& pair) { return !number.contains(pair.second); });
  for (auto& [node, v] : tagged.vertex_of_node)
    v = number.at(v);
  figure.vertices = std::move(vertices);
  figure.triangles = kept;
  for (auto& t : figure.triangles)
    for (std::int32_t& v : t)
      v = number.at(v);
}

void refuse_volume_elements(const std::string& name) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  require(types.empty(), "the mesh has volume elements: it is not of a plane body", name,
          "set [geometry] dimension = 3, or save the plane surface only");
}

} // namespace

Domain import_plane_cad(const Request& request) {
  open_cad(request);
  const auto surfaces = choose_figure(request);
  show_only(2, surfaces);
  const FileSizes file_sizes = sizes_in_file();
  gmsh::model::mesh::removeConstraints();
  if (!request.background_sizes)
    gmsh::model::mesh::field::setAsBackgroundMesh(-1);
  first_complaint();

  const double diagonal = diagonal_of(2, surfaces, request.name);
  const double size = request.mesh_size > 0      ? request.mesh_size
                      : request.background_sizes ? diagonal
                                                 : diagonal / 10;
  const Tessellation surface = tessellate(kernel_area(surfaces), size, file_sizes, request,
                                          [&] { return area_of(read_triangles(surfaces, request).figure); });
  TaggedFigure tagged = read_triangles(surfaces, request);
  require(read_sides(tagged, request), "a part of the boundary lies on no curve", request.name,
          "repair the figure: its curves may intersect");
  if (request.shape)
    tagged.figure.curves = shape_names(*request.shape, 2, tagged.curve_tags);
  Domain domain = preprocess::draw_out(tagged.figure);
  preprocess::find_corners(domain, corner_rule(tagged.curve_tags, tagged.vertex_of_node));
  read_plane_groups(tagged, surfaces, domain);
  domain.cad_volume = surface.cad_measure;
  return domain;
}

Domain import_plane_mesh(const Request& request) {
  open_file(request.file, request.name);
  refuse_volume_elements(request.name);
  require_first_order(2, request.name);
  TaggedFigure tagged = read_triangles({}, request);
  choose_piece(tagged, request);
  if (!read_sides(tagged, request)) {
    require(tagged.curve_tags.empty(),
            "some sides of the plane mesh lie on a curve of the file and some on none", request.name,
            "save all its curves or none");
    preprocess::curves_by_angle(tagged.figure, crease);
  }
  Domain domain = preprocess::draw_out(tagged.figure);
  preprocess::find_corners(domain, {});
  read_plane_groups(tagged, tags_of(2), domain);
  return domain;
}

} // namespace tessera::importer
