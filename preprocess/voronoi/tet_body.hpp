/// The body in the tessellator's own coordinates: recentred, spacing about 1, tetrahedra that know what lies
/// across each face.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// x' = (x - centre) / length. The length is a power of two, so that scaling rounds nothing.
struct Scaling {
  Vec3 centre = Vec3::Zero(); ///< m
  double length = 1;          ///< m

  Vec3 in(const Vec3& X) const { return (X - centre) / length; }
  Vec3 out(const Vec3& X) const { return centre + length * X; }
};

/// Centre of the bounding box, and the power of two nearest to `spacing` (m).
Scaling scaling_for(const Domain& domain, double spacing);

struct TetBody {
  const Domain* domain; ///< outlives this
  Scaling scaling;
  std::vector<Vec3> points; ///< the domain's vertices, scaled
  /// Across the face opposite to corner k: a tetrahedron, or -1 - f for boundary facet f.
  std::vector<std::array<std::int32_t, 4>> across;

  /// InputError where an outer face of the tetrahedra is no facet of the domain or the reverse.
  TetBody(const Domain& domain, const Scaling& scaling);
};

} // namespace tessera::preprocess
