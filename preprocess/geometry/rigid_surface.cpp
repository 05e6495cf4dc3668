#include "preprocess/geometry/rigid_surface.hpp"

#include "core/error.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace tessera::preprocess {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;

/// A triangle with the normals of its face, of the edges (k, k + 1) and of its vertices.
struct Facet {
  std::array<Vec3, 3> vertices;
  Vec3 face;
  std::array<Vec3, 3> edges, corners;
};

struct Nearest {
  Vec3 point, normal;
};

/// The point of a triangle nearest to x, with the normal of the feature it lies on (C. Ericson, Real-Time
/// Collision Detection, section 5.1.5: by the regions of vertices, edges and face).
Nearest nearest_on(const Facet& facet, const Vec3& x) {
  std::array<std::array<double, 2>, 3> along; // of edge (k, k + 1), from its first vertex: to x, whole
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = facet.vertices[(k + 1) % 3] - facet.vertices[k];
    along[k] = {edge.dot(x - facet.vertices[k]), edge.squaredNorm()};
  }
  for (int k = 0; k < 3; ++k)
    if (along[k][0] <= 0 && along[(k + 2) % 3][0] >= along[(k + 2) % 3][1])
      return {facet.vertices[k], facet.corners[k]};
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = facet.vertices[k], &b = facet.vertices[(k + 1) % 3];
    const Vec3 outwards = (b - a).cross(facet.face);
    if (outwards.dot(x - a) >= 0 && along[k][0] >= 0 && along[k][0] <= along[k][1])
      return {a + along[k][0] / along[k][1] * (b - a), facet.edges[k]};
  }
  return {x - facet.face.dot(x - facet.vertices[0]) * facet.face, facet.face};
}

double angle_at(const Vec3& corner, const Vec3& a, const Vec3& b) {
  return std::atan2((a - corner).cross(b - corner).norm(), (a - corner).dot(b - corner));
}

std::vector<Facet> facets_of(const Domain& domain, const std::string& where) {
  std::vector<Facet> facets;
  std::map<std::array<std::int32_t, 2>, std::pair<Vec3, int>> edges; // sum of normals, facets
  std::vector<Vec3> corners(domain.vertices.size(), Vec3::Zero());
  const auto edge_of = [](const Domain::Facet& facet, int k) {
    const std::int32_t a = facet.vertices[k], b = facet.vertices[(k + 1) % 3];
    return std::array{std::min(a, b), std::max(a, b)};
  };
  for (const Domain::Facet& facet : domain.facets) {
    Facet f;
    for (int k = 0; k < 3; ++k)
      f.vertices[k] = domain.vertices[facet.vertices[k]];
    const auto& v = f.vertices;
    f.face = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
    for (int k = 0; k < 3; ++k) {
      auto& [normal, count] = edges.try_emplace(edge_of(facet, k), Vec3::Zero(), 0).first->second;
      normal += f.face;
      ++count;
      corners[facet.vertices[k]] += angle_at(v[k], v[(k + 1) % 3], v[(k + 2) % 3]) * f.face;
    }
    facets.push_back(f);
  }
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto& [normal, count] = edges.at(edge_of(domain.facets[i], k));
      const Vec3& at = facets[i].vertices[k];
      require(count == 2,
              fmt::format("a wall's surface touches itself along the edge at ({:g}, {:g}, {:g})", at[0],
                          at[1], at[2]),
              where, "part its sides there, or join them");
      facets[i].edges[k] = normal.normalized();
      facets[i].corners[k] = corners[domain.facets[i].vertices[k]].normalized();
    }
  return facets;
}

} // namespace

struct RigidSurface::Tree {
  std::vector<Facet> facets;
  std::vector<Triangle> triangles;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree;
};

RigidSurface::RigidSurface(const Domain& domain, const std::string& where) {
  auto built = std::make_unique<Tree>();
  built->facets = facets_of(domain, where);
  const auto point = [](const Vec3& x) { return Point(x[0], x[1], x[2]); };
  for (const Facet& f : built->facets)
    built->triangles.emplace_back(point(f.vertices[0]), point(f.vertices[1]), point(f.vertices[2]));
  built->tree.insert(built->triangles.begin(), built->triangles.end());
  // Now and not at the first query: those must not change anything.
  built->tree.build();
  built->tree.accelerate_distance_queries();
  tree_ = std::move(built);
}

RigidSurface::~RigidSurface() = default;

RigidShape::Gap RigidSurface::gap(const Vec3& x) const {
  const auto found = tree_->tree.closest_point_and_primitive({x[0], x[1], x[2]});
  const auto& facet = tree_->facets[static_cast<std::size_t>(found.second - tree_->triangles.begin())];
  const Nearest nearest = nearest_on(facet, x);
  const Vec3 way = x - nearest.point;
  const double side = way.dot(nearest.normal) < 0 ? -1 : 1, distance = way.norm();
  // On the face its own normal is the sharper one, and on the surface the only one.
  const bool on_face = nearest.normal == facet.face;
  return {side * distance, on_face || distance == 0 ? nearest.normal : Vec3(side / distance * way)};
}

} // namespace tessera::preprocess
