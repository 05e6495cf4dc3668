/// The boundary of an imported body as a rigid tool.
#pragma once

#include "core/rigid_shape.hpp"
#include "preprocess/geometry/domain.hpp"
#include "preprocess/seeding/box_tree.hpp"

#include <array>
#include <string>
#include <vector>

namespace tessera::preprocess {

/// Signed distance to a closed triangle surface, by a tree of its facets' boxes. Its sign is that of the
/// angle-weighted normal of the nearest vertex, edge or facet, which is right wherever that point lies
/// (Baerentzen and Aanaes, Signed distance computation using the angle weighted pseudonormal, IEEE TVCG 11,
/// 2005).
class RigidSurface final : public RigidShape {
 public:
  /// A triangle with the unit normals of its face, of its edges (k, k + 1) and of its vertices.
  struct Facet {
    std::array<Vec3, 3> vertices;
    Vec3 face;
    std::array<Vec3, 3> edges, corners;
  };

  /// The facets of a body in space. InputError, naming `where`, on one whose surface touches itself along an
  /// edge: there it has no side.
  explicit RigidSurface(const Domain& domain, const std::string& where = "");

  Gap gap(const Vec3& x) const override;
  bool two_sided() const override { return true; }

 private:
  std::vector<Facet> facets_;
  BoxTree tree_;
};

} // namespace tessera::preprocess
