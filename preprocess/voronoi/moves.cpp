#include "preprocess/voronoi/moves.hpp"

#include "preprocess/seeding/nearness.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

constexpr int most_halvings = 4;

std::vector<Box> boxes_of(const TetBody& body, const std::vector<std::int32_t>& facets) {
  std::vector<Box> boxes;
  boxes.reserve(facets.size());
  for (const std::int32_t f : facets) {
    const auto& v = body.domain->facets[f].vertices;
    const Vec3 &a = body.points[v[0]], &b = body.points[v[1]], &c = body.points[v[2]];
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  return boxes;
}

std::vector<std::int32_t> facets_but_lids(const Domain& domain) {
  std::vector<std::int32_t> facets;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(domain.facets.size()); ++f)
    if (domain.facets[f].surface != Domain::lid)
      facets.push_back(f);
  return facets;
}

/// Whether the segment from a to b meets the triangle; a hair beside it counts too.
bool crosses(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& X) {
  constexpr double slack = 1e-9;
  const Vec3 normal = (X[1] - X[0]).cross(X[2] - X[0]);
  const double above = normal.dot(a - X[0]), below = normal.dot(b - X[0]);
  if ((above > 0) == (below > 0) || above == below)
    return false;
  const Vec3 p = a + above / (above - below) * (b - a);
  for (int k = 0; k < 3; ++k)
    if (normal.dot((X[(k + 1) % 3] - X[k]).cross(p - X[k])) < -slack * normal.squaredNorm())
      return false;
  return true;
}

} // namespace

Moves::Moves(const TetBody& body, const CadTopology& cad)
    : body_(body), cad_(cad), boundary_(boxes_of(body, facets_but_lids(*body.domain))),
      boundary_facets_(facets_but_lids(*body.domain)), facets_(body.domain->surfaces.size()) {
  for (const std::int32_t f : boundary_facets_)
    facets_[body.domain->facets[f].surface].push_back(f);
  surfaces_.reserve(facets_.size());
  for (const auto& facets : facets_)
    surfaces_.emplace_back(boxes_of(body, facets));
}

std::array<Vec3, 3> Moves::corners(std::int32_t facet) const {
  const auto& v = body_.domain->facets[facet].vertices;
  return {body_.points[v[0]], body_.points[v[1]], body_.points[v[2]]};
}

bool Moves::meets_boundary(const Vec3& a, const Vec3& b) const {
  return boundary_.find({a.cwiseMin(b), a.cwiseMax(b)},
                        [&](std::int32_t k) { return crosses(a, b, corners(boundary_facets_[k])); }) >= 0;
}

Vec3 Moves::inside(const Vec3& x, const Vec3& to) const {
  Vec3 way = to - x;
  for (int halvings = 0; halvings <= most_halvings; ++halvings, way /= 2)
    if (!meets_boundary(x, x + 1.1 * way))
      return x + way;
  return x;
}

bool Moves::on_curve(const Vec3& x, std::int32_t facet) const {
  constexpr double near = 1e-6; // the spacing is about 1
  const auto X = corners(facet);
  for (int k = 0; k < 3; ++k)
    if (cad_.curves_around(facet)[k] >= 0 &&
        squared_distance_to_segment(x, X[k], X[(k + 1) % 3]) < near * near)
      return true;
  return false;
}

Vec3 Moves::on_surface(const Vec3& x, const Vec3& to, std::int32_t surface) const {
  Vec3 way = to - x;
  for (int halvings = 0; halvings <= most_halvings; ++halvings, way /= 2) {
    const Vec3 p = x + way;
    const std::int32_t nearest = surfaces_[surface]
                                     .nearest(p,
                                              [&](std::int32_t k) {
                                                const auto X = corners(facets_[surface][k]);
                                                return (p - nearest_on_triangle(p, X)).squaredNorm();
                                              })
                                     .first;
    const std::int32_t facet = facets_[surface][nearest];
    const Vec3 q = nearest_on_triangle(p, corners(facet));
    if (!on_curve(q, facet))
      return q;
  }
  return x;
}

} // namespace tessera::preprocess
