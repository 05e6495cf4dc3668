/// The boundary of an imported body as a rigid tool.
#pragma once

#include "core/rigid_shape.hpp"
#include "preprocess/geometry/domain.hpp"

#include <memory>
#include <string>

namespace tessera::preprocess {

/// Signed distance to a closed triangle surface, by an AABB tree. Its sign is that of the angle-weighted
/// normal of the nearest vertex, edge or facet, which is right wherever that point lies (Baerentzen and
/// Aanaes, Signed distance computation using the angle weighted pseudonormal, IEEE TVCG 11, 2005).
class RigidSurface final : public RigidShape {
 public:
  /// The facets of a body in space. InputError, naming `where`, on one whose surface touches itself along an
  /// edge: there it has no side.
  explicit RigidSurface(const Domain& domain, const std::string& where = "");
  ~RigidSurface() override;

  Gap gap(const Vec3& x) const override;
  bool two_sided() const override { return true; }

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

} // namespace tessera::preprocess
