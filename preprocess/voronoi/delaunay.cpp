#include "preprocess/voronoi/delaunay.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace tessera::preprocess {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

void refuse_duplicates(const std::vector<Vec3>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  const auto less = [&](std::size_t a, std::size_t b) {
    const Vec3 &p = points[a], &q = points[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (points[order[k - 1]] == points[order[k]])
      throw InputError(fmt::format("points {} and {} coincide", std::min(order[k - 1], order[k]),
                                   std::max(order[k - 1], order[k])),
                       "Voronoi tessellation", "remove one of them");
}

/// Both directions of every edge, with repeats, as rows.
DelaunayGraph edges_of(const Triangulation& triangulation, std::size_t n) {
  std::vector<std::array<std::int32_t, 2>> pairs;
  if (triangulation.dimension() == 3) {
    pairs.reserve(triangulation.number_of_finite_cells() * 6);
    for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell)
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
          pairs.push_back({cell->vertex(a)->info(), cell->vertex(b)->info()});
  } else if (triangulation.dimension() > 0) {
    for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end(); ++edge)
      pairs.push_back({edge->first->vertex(edge->second)->info(), edge->first->vertex(edge->third)->info()});
  }
  DelaunayGraph graph;
  graph.rows.assign(n + 1, 0);
  for (const auto& [a, b] : pairs) {
    ++graph.rows[a + 1];
    ++graph.rows[b + 1];
  }
  for (std::size_t i = 0; i < n; ++i)
    graph.rows[i + 1] += graph.rows[i];
  graph.columns.resize(2 * pairs.size());
  std::vector<std::int64_t> fill(graph.rows.begin(), graph.rows.end() - 1);
  for (const auto& [a, b] : pairs) {
    graph.columns[static_cast<std::size_t>(fill[a]++)] = b;
    graph.columns[static_cast<std::size_t>(fill[b]++)] = a;
  }
  return graph;
}

} // namespace

DelaunayGraph delaunay_graph(const std::vector<Vec3>& points) {
  const std::size_t n = points.size();
  DelaunayGraph repeated;
  {
    std::vector<std::pair<Kernel::Point_3, std::int32_t>> input;
    input.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
      input.emplace_back(Kernel::Point_3(points[i].x(), points[i].y(), points[i].z()),
                         static_cast<std::int32_t>(i));
    const Triangulation triangulation(input.begin(), input.end());
    if (triangulation.number_of_vertices() != n)
      refuse_duplicates(points);
    repeated = edges_of(triangulation, n);
  }

  // Repeats go, the nearest neighbour comes first; the order depends on the points alone.
  std::vector<std::int64_t> degree(n);
  for_each(static_cast<std::int64_t>(n), [&](std::int64_t i) {
    const auto at = i;
    const auto begin = repeated.columns.begin() + repeated.rows[at];
    const auto end = repeated.columns.begin() + repeated.rows[at + 1];
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    const auto distance = [&](std::int32_t j) { return (points[j] - points[at]).squaredNorm(); };
    std::stable_sort(begin, last, [&](std::int32_t a, std::int32_t b) { return distance(a) < distance(b); });
    degree[at] = last - begin;
  });
  DelaunayGraph graph;
  graph.rows.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i)
    graph.rows[i + 1] = graph.rows[i] + degree[i];
  graph.columns.resize(static_cast<std::size_t>(graph.rows[n]));
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(repeated.columns.begin() + repeated.rows[i], degree[i],
                graph.columns.begin() + graph.rows[i]);
  return graph;
}

} // namespace tessera::preprocess
