/// The body in the tessellator's own coordinates: recentred, spacing about 1, tetrahedra that know what lies
/// across each face.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// x' = (x - centre) / length. The length is a power of two, so that scaling rounds nothing. The thickness of
/// a slab (z) stays as it is.
struct Scaling {
  Vec3 centre = Vec3::Zero(); ///< m
  double length = 1;          ///< m
  int dimension = 3;

  Vec3 in(const Vec3& X) const { return (X - centre).cwiseProduct(factors(1 / length)); }
  Vec3 out(const Vec3& X) const { return centre + X.cwiseProduct(factors(length)); }
  double volume() const { return dimension == 2 ? length * length : length * length * length; } ///< m^d
  double area() const { return dimension == 2 ? length : length * length; } ///< of boundary, m^(d-1)

 private:
  Vec3 factors(double f) const { return {f, f, dimension == 2 ? 1.0 : f}; }
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
