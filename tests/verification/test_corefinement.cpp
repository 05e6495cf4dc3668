/// The volume of cells at the boundary against an exact computation that shares nothing with the clipper: the
/// Voronoi cell as an intersection of half-spaces, and its intersection with the body's surface by CGAL's
/// corefinement, both with exact numbers.
#include "tests/support/domains.hpp"
#include "tests/support/tessellation.hpp"

#include <CGAL/Convex_hull_3/dual/halfspace_intersection_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tessera::preprocess {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Kernel::Point_3 exact(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

Mesh surface_of(const TetBody& body) {
  Mesh mesh;
  std::map<std::int32_t, Mesh::Vertex_index> known;
  for (const auto& facet : body.domain->facets) {
    std::array<Mesh::Vertex_index, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const auto [at, added] = known.try_emplace(facet.vertices[k]);
      if (added)
        at->second = mesh.add_vertex(exact(body.points[facet.vertices[k]]));
      corners[k] = at->second;
    }
    EXPECT_NE(mesh.add_face(corners[0], corners[1], corners[2]), Mesh::null_face());
  }
  return mesh;
}

/// The whole Voronoi cell within a box around the body.
Mesh voronoi_cell(const test::Tessellation& t, std::int32_t i) {
  const Kernel::Point_3 seed = exact(t.seeds[i]);
  const int reach = 1000;
  std::vector<Kernel::Plane_3> planes{{1, 0, 0, -reach},  {-1, 0, 0, -reach}, {0, 1, 0, -reach},
                                      {0, -1, 0, -reach}, {0, 0, 1, -reach},  {0, 0, -1, -reach}};
  for (const std::int32_t j : t.graph.of(i))
    planes.push_back(CGAL::bisector(exact(t.seeds[j]), seed).opposite());
  // Negative sides are kept.
  for (auto& plane : planes)
    if (plane.has_on_positive_side(seed))
      plane = plane.opposite();
  Mesh mesh;
  CGAL::halfspace_intersection_3(planes.begin(), planes.end(), mesh, seed);
  CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  return mesh;
}

/// Of every `every`-th cell at the boundary.
void expect_exact_volumes(const Domain& domain, int seeds, int every) {
  const test::Tessellation t(domain, test::random_points(domain, seeds));
  const CellMeasures measures = measure_cells(t.voronoi);
  std::vector<double> owned = measures.volume; // without what was handed from cell to cell
  for (const auto& orphan : measures.orphans) {
    owned[orphan.receiver] -= orphan.volume;
    owned[orphan.cell] += orphan.volume;
  }
  const Mesh surface = surface_of(t.body);
  const double mean = domain.volume / t.volume(1) / seeds;
  int met = 0, checked = 0;
  for (std::int32_t i = 0; i < seeds; ++i) {
    if (!t.voronoi.meets_boundary(i) || met++ % every != 0)
      continue;
    Mesh body = surface, cell = voronoi_cell(t, i), both;
    ASSERT_TRUE(CGAL::Polygon_mesh_processing::corefine_and_compute_intersection(body, cell, both)) << i;
    EXPECT_NEAR(owned[i] / mean, CGAL::to_double(CGAL::Polygon_mesh_processing::volume(both)) / mean, 1e-12)
        << i;
    ++checked;
  }
  EXPECT_GE(checked, 50);
}

} // namespace

TEST(Corefinement, CellsOfAnLPart) {
  expect_exact_volumes(test::l_domain(1), 300, 1);
}

TEST(Corefinement, CellsOfAHoledBody) {
  expect_exact_volumes(test::holed_domain(2), 400, 2);
}

TEST(Corefinement, CellsAcrossASlot) {
  expect_exact_volumes(test::slotted_domain(1, 0.05), 300, 2);
}

} // namespace tessera::preprocess
