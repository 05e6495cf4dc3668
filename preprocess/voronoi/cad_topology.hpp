/// Which CAD surfaces, curves and corners of a body meet.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Where a particle sits: a corner (entity: the domain's vertex), a curve, a surface, or inside (entity -1).
/// In a slab: a corner, a curve (entity: the wall's surface), or inside (dimension 2, entity -1).
struct CadPlace {
  std::uint8_t dimension = 3;
  std::int32_t entity = -1;
};

/// A slab's topology is the plane's: a curve lies on the one wall below it, a corner on the walls that meet
/// there, lids on nothing; walls share a curve where they share a corner (the upright edge over it).
class CadTopology {
 public:
  explicit CadTopology(const Domain& domain);

  /// Surfaces that contain a place, ascending.
  const std::vector<std::int32_t>& surfaces_of(const CadPlace& place) const;

  bool on_surface(const CadPlace& place, std::int32_t surface) const;
  bool on_curve(const CadPlace& place, std::int32_t curve) const;

  bool curve_ends_at(std::int32_t curve, std::int32_t corner) const;
  bool curves_share_a_corner(std::int32_t a, std::int32_t b) const;
  bool surfaces_share_a_curve(std::int32_t a, std::int32_t b) const;

  /// Curve along the edge from vertex k to vertex k + 1 of a facet, -1 where the surface runs on.
  const std::array<std::int32_t, 3>& curves_around(std::int32_t facet) const { return curves_around_[facet]; }
  /// Facet across that edge where the surface runs on, -1 along curves.
  const std::array<std::int32_t, 3>& smooth_across(std::int32_t facet) const { return smooth_across_[facet]; }
  bool is_corner(std::int32_t vertex) const { return corner_[vertex] >= 0; }

 private:
  std::vector<std::vector<std::int32_t>> curve_surfaces_, curve_corners_; ///< by curve
  std::vector<std::vector<std::int32_t>> corner_surfaces_;                ///< by corner
  std::vector<std::vector<std::int32_t>> surface_neighbours_;             ///< by surface
  std::vector<std::vector<std::int32_t>> surface_itself_;                 ///< by surface
  std::vector<std::int32_t> corner_;                                      ///< by vertex; -1: no corner
  std::vector<std::array<std::int32_t, 3>> curves_around_, smooth_across_;
};

} // namespace tessera::preprocess
