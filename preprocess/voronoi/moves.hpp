/// Moves of points that respect the body: never through its boundary, or along one of its surfaces.
#pragma once

#include "preprocess/seeding/box_tree.hpp"
#include "preprocess/voronoi/cad_topology.hpp"
#include "preprocess/voronoi/tet_body.hpp"

#include <vector>

namespace tessera::preprocess {

/// In the body's scaled coordinates. Any number of threads may ask at once.
class Moves {
 public:
  Moves(const TetBody& body, const CadTopology& cad);

  /// `to`, or the first of the points halfway there, a quarter of the way... that x reaches without touching
  /// the boundary, with a tenth of the way to spare; else x.
  Vec3 inside(const Vec3& x, const Vec3& to) const;

  /// The point of a CAD surface nearest to `to`, or to the first of the points halfway there... whose nearest
  /// one is not on a curve around the surface; else x.
  Vec3 on_surface(const Vec3& x, const Vec3& to, std::int32_t surface) const;

 private:
  bool meets_boundary(const Vec3& a, const Vec3& b) const;
  bool on_curve(const Vec3& x, std::int32_t facet) const;
  std::array<Vec3, 3> corners(std::int32_t facet) const;

  const TetBody& body_;
  const CadTopology& cad_;
  BoxTree boundary_;                              ///< without lids
  std::vector<std::int32_t> boundary_facets_;     ///< its items
  std::vector<BoxTree> surfaces_;                 ///< by CAD surface
  std::vector<std::vector<std::int32_t>> facets_; ///< of each: its items
};

} // namespace tessera::preprocess
