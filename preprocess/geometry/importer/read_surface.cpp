#include "core/error.hpp"
#include "preprocess/geometry/cad_file.hpp"
#include "preprocess/geometry/importer/triangle_surface.hpp"
#include "preprocess/geometry/weld.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace tessera::importer {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Polygon = std::vector<std::size_t>;

struct Soup {
  std::vector<Point> points;
  std::vector<Polygon> polygons;
};

/// CGAL knows the words of a text file in small letters only.
std::string stl_in_small_letters(std::string text) {
  constexpr std::string_view loud = "SOLID";
  const bool as_text = text.starts_with(loud) && text.find("FACET") != std::string::npos &&
                       text.find('\0') == std::string::npos;
  if (as_text)
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// CGAL 5.5 crashes on a header whose properties begin before any element.
bool has_ply_header(std::string_view text) {
  const auto element = text.find("element "), property = text.find("property ");
  return text.starts_with("ply") && element != std::string_view::npos && element < property;
}

Soup read_soup(const Request& request) {
  Soup soup;
  std::istringstream in(preprocess::read_text(request.file));
  const char* kind = "";
  bool good = false;
  switch (preprocess::check_cad_file(request.file)) {
  case preprocess::CadFormat::stl:
    kind = "STL";
    in.str(stl_in_small_letters(in.str()));
    good = CGAL::IO::read_STL(in, soup.points, soup.polygons);
    break;
  case preprocess::CadFormat::obj:
    kind = "OBJ";
    good = CGAL::IO::read_OBJ(in, soup.points, soup.polygons);
    break;
  default:
    kind = "PLY";
    good = has_ply_header(in.str()) && CGAL::IO::read_PLY(in, soup.points, soup.polygons);
  }
  const char* again = "export or copy it again";
  require(good, fmt::format("the file is no {} file, or it is cut off or damaged", kind), request.name,
          again);
  require(!soup.polygons.empty(), fmt::format("there are no triangles in the {} file", kind), request.name,
          again);
  for (const Polygon& polygon : soup.polygons)
    for (const std::size_t v : polygon)
      require(v < soup.points.size(),
              fmt::format("a polygon of the {} file names a vertex that is not there", kind), request.name,
              again);
  for (const Point& X : soup.points)
    require(std::isfinite(X.x()) && std::isfinite(X.y()) && std::isfinite(X.z()),
            fmt::format("the {} file has a coordinate that is not a number", kind), request.name, again);
  return soup;
}

/// Makes corners of nearly the same place the same corner.
void weld(Soup& soup, const std::string& name) {
  std::vector<Vec3> points;
  for (const Point& X : soup.points)
    points.emplace_back(X.x(), X.y(), X.z());
  Vec3 lower = points[0], upper = lower;
  for (const Vec3& X : points) {
    lower = lower.cwiseMin(X);
    upper = upper.cwiseMax(X);
  }
  const double diagonal = (upper - lower).norm();
  require(diagonal > 0 && std::isfinite(diagonal), "the surface has no extent", name, "export it again");
  const auto vertex = preprocess::weld(points, 1e-7 * diagonal);
  for (Polygon& polygon : soup.polygons)
    for (std::size_t& v : polygon)
      v = static_cast<std::size_t>(vertex[v]);
}

/// Triangles of one polygon with more corners.
void triangulate(const Soup& soup, const Polygon& polygon, std::vector<preprocess::Triangle>& triangles,
                 const std::string& name) {
  CGAL::Surface_mesh<Point> mesh;
  std::vector<CGAL::SM_Vertex_index> corners;
  for (const std::size_t v : polygon)
    corners.push_back(mesh.add_vertex(soup.points[v]));
  mesh.add_face(corners);
  const Point& X = soup.points[polygon[0]];
  require(CGAL::Polygon_mesh_processing::triangulate_faces(mesh),
          fmt::format(
              "a polygon of {} corners near ({:.6g}, {:.6g}, {:.6g}) in the file's unit cannot be cut into "
              "triangles",
              polygon.size(), X.x(), X.y(), X.z()),
          name, "export the surface as triangles");
  for (const auto face : mesh.faces()) {
    preprocess::Triangle triangle;
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face)))
      triangle[k++] = static_cast<std::int32_t>(polygon[v]);
    triangles.push_back(triangle);
  }
}

} // namespace

preprocess::Triangles read_surface(const Request& request) {
  Soup soup = read_soup(request);
  weld(soup, request.name);
  CGAL::Polygon_mesh_processing::repair_polygon_soup(soup.points, soup.polygons);
  require(!soup.polygons.empty(), "all triangles of the file are without area", request.name,
          "export it again");
  preprocess::Triangles surface;
  for (const Point& X : soup.points)
    surface.vertices.emplace_back(X.x(), X.y(), X.z());
  for (const Polygon& polygon : soup.polygons) {
    if (polygon.size() == 3)
      surface.triangles.push_back({static_cast<std::int32_t>(polygon[0]),
                                   static_cast<std::int32_t>(polygon[1]),
                                   static_cast<std::int32_t>(polygon[2])});
    else
      triangulate(soup, polygon, surface.triangles, request.name);
  }
  return surface;
}

} // namespace tessera::importer
