#include "preprocess/seeding/body_boxes.hpp"

#include <cmath>

namespace tessera::preprocess {
namespace {

std::vector<Box> boxes_of_facets(const TetBody& body) {
  std::vector<Box> boxes;
  boxes.reserve(body.domain->facets.size());
  for (const auto& facet : body.domain->facets) {
    const Vec3 &a = body.points[facet.vertices[0]], &b = body.points[facet.vertices[1]],
               &c = body.points[facet.vertices[2]];
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  return boxes;
}

} // namespace

BodyBoxes::BodyBoxes(const TetBody& body)
    : body_(body), locator_(*body.domain, body.points), boundary_(boxes_of_facets(body)) {}

bool BodyBoxes::meets_boundary(const Cube& cube) const {
  const Vec3 out = Vec3::Constant(cube.half);
  return boundary_.find({cube.middle - out, cube.middle + out}, [&](std::int32_t f) {
    const auto& v = body_.domain->facets[f].vertices;
    const Vec3& a = body_.points[v[0]];
    const Vec3 normal = (body_.points[v[1]] - a).cross(body_.points[v[2]] - a);
    return std::abs(normal.dot(cube.middle - a)) <= cube.half * normal.lpNorm<1>();
  }) >= 0;
}

std::vector<Cube> BodyBoxes::cover(const std::function<double(const Cube&)>& side) const {
  Vec3 lower = body_.points[0], upper = body_.points[0];
  for (const Vec3& x : body_.points) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  std::vector<Cube> cubes;
  cover({(lower + upper) / 2, (upper - lower).maxCoeff() / 2, false}, side, cubes);
  return cubes;
}

void BodyBoxes::cover(Cube cube, const std::function<double(const Cube&)>& side,
                      std::vector<Cube>& cubes) const {
  if (!cube.inside && !meets_boundary(cube)) {
    cube.inside = holds(cube.middle);
    if (!cube.inside)
      return;
  }
  if (2 * cube.half <= side(cube))
    cubes.push_back(cube);
  else
    each_octant(cube, [&](const Cube& octant) { cover(octant, side, cubes); });
}

} // namespace tessera::preprocess
