#include "preprocess/voronoi/delaunay.hpp"

#include "core/parallel.hpp"
#include "preprocess/voronoi/point_parts.hpp"
#include "preprocess/voronoi/rim.hpp"
#include "preprocess/voronoi/simplices.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace tessera::preprocess {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// What is known of a tetrahedron when a point set is triangulated in parts.
struct Standing {
  bool sure = true;          ///< belongs to the triangulation of the whole set
  bool thin = false;         ///< too flat for its circumsphere to be computed: as sure as its neighbours
  std::uint8_t barriers = 0; ///< bit k: across face k lies what another triangulation is sure of
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<Standing, Kernel,
                                                           CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;
using Cell = Triangulation::Cell_handle;

constexpr std::int32_t infinite = -1;

/// CGAL perturbs degenerate sets by the order of the coordinates: the triangulation of a set is unique.
Triangulation triangulation_of(const std::vector<Vec3>& points, const std::vector<std::int32_t>& chosen) {
  std::vector<std::pair<Kernel::Point_3, std::int32_t>> input;
  input.reserve(chosen.size());
  for (const std::int32_t i : chosen)
    input.emplace_back(Kernel::Point_3(points[i].x(), points[i].y(), points[i].z()), i);
  Triangulation result(input.begin(), input.end());
  result.infinite_vertex()->info() = infinite;
  return result;
}

Simplex simplex_of(const Cell& cell) {
  return {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()};
}

/// Face k of a cell, oriented as seen from that cell.
std::array<std::int32_t, 3> face_of(const Cell& cell, int k) {
  std::array<std::int32_t, 3> face;
  for (int c = 0; c < 3; ++c)
    face[c] = cell->vertex(Triangulation::vertex_triple_index(k, c))->info();
  return face;
}

std::vector<Simplex> simplices_of(const Triangulation& triangulation) {
  std::vector<Simplex> result;
  switch (triangulation.dimension()) {
  case 3:
    result.reserve(triangulation.number_of_cells());
    for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell)
      result.push_back(simplex_of(cell));
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

/// What the points of one part say by themselves.
struct PartResult {
  bool solid = false;             ///< its points span space
  std::vector<Simplex> sure;      ///< finite tetrahedra of the whole triangulation
  std::vector<std::int32_t> open; ///< points of the other tetrahedra
  std::vector<OrientedFace> rim;  ///< faces between the two kinds, seen from the unsure side
};

/// Tetrahedra whose circumspheres no other part can reach are Delaunay's for the whole set.
PartResult triangulate_part(const std::vector<Vec3>& points, const PointParts& parts, std::int64_t own) {
  PartResult result;
  const Triangulation triangulation = triangulation_of(points, parts.members[own]);
  result.solid =
      triangulation.dimension() == 3 && triangulation.number_of_vertices() == parts.members[own].size();
  if (!result.solid)
    return result;
  std::vector<Cell> unsure, front;
  for (auto at = triangulation.all_cells_begin(); at != triangulation.all_cells_end(); ++at) {
    const Cell cell = at;
    const Reach reach = reach_of(points, parts, own, simplex_of(cell));
    cell->info().thin = reach == Reach::unknown;
    if (reach == Reach::others)
      unsure.push_back(cell);
  }
  for (const Cell& cell : unsure)
    cell->info().sure = false;
  // A sphere lies within those of the neighbours and the tetrahedron itself: a thin one is sure if all around
  // it are.
  for (front = unsure; !front.empty();) {
    const Cell cell = front.back();
    front.pop_back();
    for (int k = 0; k < 4; ++k) {
      const Cell next = cell->neighbor(k);
      if (!next->info().thin || !next->info().sure)
        continue;
      next->info().sure = false;
      unsure.push_back(next);
      front.push_back(next);
    }
  }
  for (const Cell& cell : unsure)
    for (int k = 0; k < 4; ++k) {
      if (cell->vertex(k)->info() != infinite)
        result.open.push_back(cell->vertex(k)->info());
      if (cell->neighbor(k)->info().sure)
        result.rim.emplace_back(face_of(cell, k));
    }
  std::sort(result.open.begin(), result.open.end());
  result.open.erase(std::unique(result.open.begin(), result.open.end()), result.open.end());
  result.sure.reserve(triangulation.number_of_cells() - unsure.size());
  for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell)
    if (cell->info().sure)
      result.sure.push_back(simplex_of(cell));
  return result;
}

/// The tetrahedra of the whole triangulation that no part is sure of: all of them have their corners among
/// the `open` points, are Delaunay's there too, and lie behind the rims. None where the rims do not close.
std::optional<std::vector<Simplex>> close_gap(const std::vector<Vec3>& points,
                                              const std::vector<PartResult>& parts) {
  std::vector<std::int32_t> open;
  std::vector<OrientedFace> rim;
  for (const PartResult& part : parts) {
    open.insert(open.end(), part.open.begin(), part.open.end());
    rim.insert(rim.end(), part.rim.begin(), part.rim.end());
  }
  const Rim faces(rim);
  const Triangulation triangulation = triangulation_of(points, open);
  if (triangulation.dimension() != 3 || triangulation.number_of_vertices() != open.size())
    return std::nullopt;
  std::size_t inner = 0, outer = 0;
  std::vector<Cell> front;
  for (auto at = triangulation.all_cells_begin(); at != triangulation.all_cells_end(); ++at) {
    const Cell cell = at;
    bool behind = rim.empty();
    for (int k = 0; k < 4; ++k) {
      const Rim::Side side = faces.side(OrientedFace(face_of(cell, k)));
      if (side == Rim::Side::none)
        continue;
      cell->info().barriers |= static_cast<std::uint8_t>(1 << k);
      behind |= side == Rim::Side::inner;
      ++(side == Rim::Side::inner ? inner : outer);
    }
    cell->info().sure = behind;
    if (behind)
      front.push_back(cell);
  }
  if (inner != rim.size() || outer != rim.size())
    return std::nullopt;
  std::vector<Simplex> result;
  while (!front.empty()) {
    const Cell cell = front.back();
    front.pop_back();
    if (!triangulation.is_infinite(cell))
      result.push_back(simplex_of(cell));
    for (int k = 0; k < 4; ++k) {
      const Cell next = cell->neighbor(k);
      if ((cell->info().barriers >> k & 1) || next->info().sure)
        continue;
      next->info().sure = true;
      front.push_back(next);
    }
  }
  return result;
}

std::vector<Simplex> triangulate(const std::vector<Vec3>& points) {
  std::vector<std::int32_t> all(points.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = static_cast<std::int32_t>(i);
  const Triangulation triangulation = triangulation_of(points, all);
  if (triangulation.number_of_vertices() != points.size())
    refuse_coinciding(points);
  return simplices_of(triangulation);
}

/// The same tetrahedra, one part of the points a thread. None where the points are in no position for it.
std::optional<std::vector<Simplex>> triangulate_in_parts(const std::vector<Vec3>& points,
                                                         std::int64_t count) {
  const PointParts parts(points, count);
  std::vector<PartResult> found(count);
  for_each_task(count, [&](std::int64_t p) { found[p] = triangulate_part(points, parts, p); });
  if (!std::all_of(found.begin(), found.end(), [](const PartResult& part) { return part.solid; }))
    return std::nullopt;
  auto result = close_gap(points, found);
  if (result)
    for (const PartResult& part : found)
      result->insert(result->end(), part.sure.begin(), part.sure.end());
  return result;
}

} // namespace

DelaunayGraph delaunay_graph(const std::vector<Vec3>& points) {
  // The gap is closed on one thread and grows with the number of parts.
  constexpr std::int64_t worth_a_part = 4000, most_parts = 8;
  const std::int64_t parts = std::min<std::int64_t>(
      {threads(), most_parts, static_cast<std::int64_t>(points.size()) / worth_a_part});
  if (parts > 1)
    if (const auto simplices = triangulate_in_parts(points, parts))
      return graph_of(points, *simplices);
  return graph_of(points, triangulate(points));
}

} // namespace tessera::preprocess
