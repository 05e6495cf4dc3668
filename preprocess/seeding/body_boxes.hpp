/// Cubes that cover a body in space, each as large as the particles there are wide.
#pragma once

#include "preprocess/seeding/tet_locator.hpp"
#include "preprocess/voronoi/tet_body.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace tessera::preprocess {

struct Cube {
  Vec3 middle;
  double half;        ///< of its side
  bool inside = true; ///< wholly; else the boundary may pass through it
};

/// In the body's scaled coordinates. Any number of threads may ask at once.
class BodyBoxes {
 public:
  explicit BodyBoxes(const TetBody& body);

  bool holds(const Vec3& x) const { return locator_.locate(x) >= 0; }

  /// Halves a cube around the body until the sides are at most `side` of the place; leaves out what lies
  /// outside. In the order of an octree.
  std::vector<Cube> cover(const std::function<double(const Cube&)>& side) const;

 private:
  void cover(Cube cube, const std::function<double(const Cube&)>& side, std::vector<Cube>& cubes) const;
  bool meets_boundary(const Cube& cube) const;

  const TetBody& body_;
  TetLocator locator_;
  BoxTree boundary_;
};

/// The eight halves of a cube along each axis.
template <class F>
void each_octant(const Cube& cube, F&& f) {
  Cube part = cube;
  part.half = cube.half / 2;
  for (int octant = 0; octant < 8; ++octant) {
    part.middle = cube.middle + Vec3(octant & 4 ? part.half : -part.half, octant & 2 ? part.half : -part.half,
                                     octant & 1 ? part.half : -part.half);
    f(part);
  }
}

} // namespace tessera::preprocess
