#include "preprocess/voronoi/delaunay.hpp"

#include "preprocess/voronoi/simplices.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

namespace tessera::preprocess {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

std::vector<Simplex> simplices_of(const Triangulation& triangulation) {
  std::vector<Simplex> result;
  switch (triangulation.dimension()) {
  case 3:
    result.reserve(triangulation.number_of_cells());
    for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell)
      result.push_back({cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(),
                        cell->vertex(3)->info()});
    break;
  case 2:
    result.reserve(2 * triangulation.number_of_vertices());
    for (auto facet = triangulation.finite_facets_begin(); facet != triangulation.finite_facets_end();
         ++facet)
      result.push_back({facet->first->vertex(0)->info(), facet->first->vertex(1)->info(),
                        facet->first->vertex(2)->info(), -1});
    break;
  case 1:
    for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end(); ++edge)
      result.push_back(
          {edge->first->vertex(edge->second)->info(), edge->first->vertex(edge->third)->info(), -1, -1});
    break;
  default:
    break;
  }
  return result;
}

std::vector<Simplex> triangulate(const std::vector<Vec3>& points) {
  std::vector<std::pair<Kernel::Point_3, std::int32_t>> input;
  input.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    input.emplace_back(Kernel::Point_3(points[i].x(), points[i].y(), points[i].z()),
                       static_cast<std::int32_t>(i));
  const Triangulation triangulation(input.begin(), input.end());
  if (triangulation.number_of_vertices() != points.size())
    refuse_coinciding(points);
  return simplices_of(triangulation);
}

} // namespace

DelaunayGraph delaunay_graph(const std::vector<Vec3>& points) {
  return graph_of(points, triangulate(points));
}

} // namespace tessera::preprocess
