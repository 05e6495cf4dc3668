/// A rigid half-space.
#pragma once

#include "core/error.hpp"
#include "core/rigid_shape.hpp"

namespace tessera::solver {

/// normal . (x - point) >= 0 is free.
class Plane final : public RigidShape {
 public:
  /// `normal` need not be of unit length; InputError, naming `where`, on one of no length.
  explicit Plane(const Vec3& point = Vec3::Zero(), const Vec3& normal = Vec3::UnitZ(),
                 const std::string& where = "")
      : point_(point), normal_(normal.normalized()) {
    require(point.allFinite() && normal.allFinite() && normal.norm() > 0, "a wall's plane has no normal",
            where, "point it to the body's side");
  }

  Gap gap(const Vec3& x) const override { return {normal_.dot(x - point_), normal_}; }

  const Vec3& normal() const { return normal_; }

 private:
  Vec3 point_, normal_;
};

} // namespace tessera::solver
