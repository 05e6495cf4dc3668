/// A rigid tool a body may meet, as the signed distance to its surface.
#pragma once

#include "core/tensor.hpp"

namespace tessera {

/// Queries are const and may come from any number of threads. SI units; z = 0 where the body is plane.
class RigidShape {
 public:
  struct Gap {
    double distance; ///< to the nearest point of the surface, negative inside the tool, m
    Vec3 normal;     ///< outward unit normal of the tool there: at edges and corners the way to x, or from it
  };

  virtual ~RigidShape() = default;

  /// The distance changes by no more than x moves.
  virtual Gap gap(const Vec3& x) const = 0;

  /// A closed surface that may be a tool or its cavity: the side the body begins on is free.
  virtual bool two_sided() const { return false; }
};

} // namespace tessera
