#include "core/error.hpp"
#include "preprocess/geometry/importer/bodies.hpp"
#include "preprocess/geometry/importer/note.hpp"
#include "preprocess/geometry/importer/triangle_surface.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tessera::importer {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using preprocess::Triangles;

constexpr const char* repair = "repair the surface in the program it comes from";

std::string near(const Vec3& X) {
  return fmt::format("near ({:.6g}, {:.6g}, {:.6g}) in the file's unit", X[0], X[1], X[2]);
}

Vec3 vec(const Point& X) {
  return {X.x(), X.y(), X.z()};
}

/// "1 hole", "3 holes".
std::string counted(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

void refuse_crowded_edges(const Triangles& surface, const std::string& name) {
  std::map<preprocess::Edge, int> uses;
  for (const auto& t : surface.triangles)
    for (int e = 0; e < 3; ++e) {
      const auto [a, b] = std::minmax(t[e], t[(e + 1) % 3]);
      ++uses[{a, b}];
    }
  std::erase_if(uses, [](const auto& use) { return use.second <= 2; });
  if (uses.empty())
    return;
  const auto& [edge, count] = *uses.begin();
  throw InputError(
      fmt::format("the surface is not manifold: {} with more than two triangles, the first with {} {}",
                  counted(uses.size(), "edge"), count,
                  near((surface.vertices[edge[0]] + surface.vertices[edge[1]]) / 2)),
      name, "take away inner walls, or export its bodies one by one");
}

struct Hole {
  std::size_t edges;
  Vec3 centre;
  Mesh::Halfedge_index border;
};

std::vector<Hole> holes_in(const Mesh& mesh) {
  std::vector<Mesh::Halfedge_index> cycles;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(cycles));
  std::vector<Hole> holes;
  for (const auto border : cycles) {
    Hole hole{0, Vec3::Zero(), border};
    for (const auto h : CGAL::halfedges_around_face(border, mesh)) {
      hole.centre += vec(mesh.point(mesh.target(h)));
      ++hole.edges;
    }
    hole.centre /= static_cast<double>(hole.edges);
    holes.push_back(hole);
  }
  return holes;
}

/// Closes the small ones, if that is wanted, and refuses what stays open.
void close_holes(Mesh& mesh, const Request& request) {
  std::vector<Hole> open;
  std::size_t closed = 0, largest = 0;
  for (const Hole& hole : holes_in(mesh)) {
    std::vector<Mesh::Face_index> patch;
    if (hole.edges <= static_cast<std::size_t>(request.close_holes))
      pmp::triangulate_hole(mesh, hole.border, std::back_inserter(patch));
    if (patch.empty()) {
      open.push_back(hole);
      continue;
    }
    ++closed;
    largest = std::max(largest, hole.edges);
  }
  if (!open.empty()) {
    const auto& most = *std::max_element(open.begin(), open.end(),
                                         [](const Hole& a, const Hole& b) { return a.edges < b.edges; });
    throw InputError(
        fmt::format("the surface is open: {}, the largest of {} edges {}", counted(open.size(), "hole"),
                    most.edges, near(most.centre)),
        request.name,
        fmt::format(
            "close the surface, or let holes of up to N edges be closed with [geometry] close_holes = N{}",
            request.close_holes > 0 ? fmt::format(" (it is {})", request.close_holes) : ""));
  }
  if (closed > 0)
    note(fmt::format("closed {} in the surface, the largest of {} edges", counted(closed, "hole"), largest));
}

void refuse_self_intersections(const Mesh& mesh, const std::string& name) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  if (pairs.empty())
    return;
  for (auto& [a, b] : pairs)
    if (b < a)
      std::swap(a, b);
  const auto face = std::min_element(pairs.begin(), pairs.end())->first;
  Vec3 centre = Vec3::Zero();
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(face)))
    centre += vec(mesh.point(v)) / 3;
  throw InputError(fmt::format("the surface intersects itself: {} of triangles, the first {}",
                               counted(pairs.size(), "pair"), near(centre)),
                   name, "unite its bodies or repair it in the program it comes from");
}

/// The mesh of an orientable surface, open or closed.
Mesh mesh_of(const Triangles& surface, const Request& request) {
  std::vector<Point> points;
  for (const Vec3& X : surface.vertices)
    points.emplace_back(X[0], X[1], X[2]);
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& t : surface.triangles)
    triangles.push_back(
        {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
  pmp::orient_polygon_soup(points, triangles); // gives each fan around a pinched vertex a vertex of its own
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  close_holes(mesh, request);
  const std::size_t pinched = points.size() - surface.vertices.size();
  require(pinched == 0,
          fmt::format("the surface is not manifold: it touches itself in {}, the first {}",
                      counted(pinched, "point"),
                      near(pinched == 0 ? Vec3(Vec3::Zero()) : vec(points[surface.vertices.size()]))),
          request.name, repair);
  return mesh;
}

} // namespace

Triangles closed_surface(const Triangles& surface, const Request& request) {
  refuse_crowded_edges(surface, request.name);
  Triangles turned = surface;
  require(preprocess::orient(turned.triangles), "the surface has only one side: it cannot bound a body",
          request.name, repair);
  Mesh mesh = mesh_of(turned, request);
  require(pmp::remove_degenerate_faces(mesh),
          "the surface has triangles without area that cannot be taken out", request.name, repair);
  mesh.collect_garbage();
  require(mesh.number_of_faces() > 0, "all triangles of the file are without area", request.name, repair);
  refuse_self_intersections(mesh, request.name);
  pmp::orient_to_bound_a_volume(mesh);

  // Solids numbered by their first triangle.
  auto volume_of = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:volume").first;
  pmp::volume_connected_components(mesh, volume_of, CGAL::parameters::do_orientation_tests(false));
  std::map<std::size_t, std::size_t> number;
  std::vector<Candidate> solids;
  const Vec3 origin = vec(mesh.point(*mesh.vertices().begin()));
  for (const auto face : mesh.faces()) {
    std::array<Vec3, 3> X;
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face)))
      X[k++] = vec(mesh.point(v));
    const auto [it, added] = number.try_emplace(volume_of[face], solids.size());
    if (added)
      solids.push_back({{}, 0, X[0], X[0]});
    Candidate& solid = solids[it->second];
    solid.measure += (X[0] - origin).dot((X[1] - origin).cross(X[2] - origin)) / 6;
    for (const Vec3& corner : X) {
      solid.lower = solid.lower.cwiseMin(corner);
      solid.upper = solid.upper.cwiseMax(corner);
    }
  }
  const std::size_t chosen = choose_body(solids, request, "separate solid");

  Triangles result;
  std::map<Mesh::Vertex_index, std::int32_t> vertex;
  for (const auto face : mesh.faces()) {
    if (number.at(volume_of[face]) != chosen)
      continue;
    preprocess::Triangle triangle;
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) {
      const auto [it, added] = vertex.try_emplace(v, static_cast<std::int32_t>(result.vertices.size()));
      if (added)
        result.vertices.push_back(vec(mesh.point(v)));
      triangle[k++] = it->second;
    }
    result.triangles.push_back(triangle);
  }
  const auto shells = preprocess::shells_of(result.triangles);
  if (const auto inner = *std::max_element(shells.begin(), shells.end()); inner > 0)
    note(fmt::format("{} inside the surface bounds a cavity, not material",
                     counted(static_cast<std::size_t>(inner), "closed shell")));
  return result;
}

} // namespace tessera::importer
