#include "preprocess/geometry/rigid_surface.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace tessera::preprocess {
namespace {

using Facet = RigidSurface::Facet;

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

std::vector<Box> boxes_of(const std::vector<Facet>& facets) {
  std::vector<Box> boxes;
  for (const Facet& f : facets) {
    const auto& v = f.vertices;
    boxes.push_back({v[0].cwiseMin(v[1]).cwiseMin(v[2]), v[0].cwiseMax(v[1]).cwiseMax(v[2])});
  }
  return boxes;
}

} // namespace

RigidSurface::RigidSurface(const Domain& domain, const std::string& where)
    : facets_(facets_of(domain, where)), tree_(boxes_of(facets_)) {}

RigidShape::Gap RigidSurface::gap(const Vec3& x) const {
  const auto found =
      tree_.nearest(x, [&](std::int32_t i) { return (x - nearest_on(facets_[i], x).point).squaredNorm(); });
  const Facet& facet = facets_[found.first];
  const Nearest nearest = nearest_on(facet, x);
  const Vec3 way = x - nearest.point;
  const double side = way.dot(nearest.normal) < 0 ? -1 : 1, distance = way.norm();
  // On the face its own normal is the sharper one, and on the surface the only one.
  const bool on_face = nearest.normal == facet.face;
  return {side * distance, on_face || distance == 0 ? nearest.normal : Vec3(side / distance * way)};
}

} // namespace tessera::preprocess
