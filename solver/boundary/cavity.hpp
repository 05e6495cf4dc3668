/// A closed surface the body is inside of.
#pragma once

#include "core/rigid_shape.hpp"

#include <cmath>
#include <memory>
#include <span>
#include <utility>

namespace tessera::solver {

/// Inside and outside of a shape exchanged.
class Cavity final : public RigidShape {
 public:
  explicit Cavity(std::shared_ptr<const RigidShape> shape) : shape_(std::move(shape)) {}

  Gap gap(const Vec3& x) const override {
    const Gap gap = shape_->gap(x);
    return {-gap.distance, -gap.normal};
  }

 private:
  std::shared_ptr<const RigidShape> shape_;
};

/// The shape itself, or its cavity where the body of these particles begins inside a closed surface: the
/// particle farthest from the surface tells.
inline std::shared_ptr<const RigidShape> on_the_bodys_side(std::shared_ptr<const RigidShape> shape,
                                                           std::span<const Vec3> X) {
  if (!shape->two_sided())
    return shape;
  double farthest = 0;
  for (const Vec3& x : X)
    if (const double distance = shape->gap(x).distance; std::abs(distance) > std::abs(farthest))
      farthest = distance;
  if (farthest >= 0)
    return shape;
  return std::make_shared<const Cavity>(std::move(shape));
}

} // namespace tessera::solver
