/// Where Lloyd's method sends a point: the weighted centroid of its own part of the body or of a surface.
#pragma once

#include "preprocess/seeding/size_field.hpp"
#include "preprocess/voronoi/restricted_voronoi.hpp"

#include <optional>

namespace tessera::preprocess {

/// Centroids weighted by size^-(k + 2) on sets of dimension k, which spreads points with spacings in
/// proportion to the size (Du, Faber and Gunzburger 1999). The size counts as linear over a cell. Only the
/// part of a cell that hangs together with its point counts: what lies across a slot does not.
class CellCentroids {
 public:
  CellCentroids(const RestrictedVoronoi& voronoi, const SizeField& size) : voronoi_(voronoi), size_(size) {}

  Vec3 of_cell(std::int64_t i) const;

  /// Of what the cell owns of a CAD surface; empty where that is nothing.
  std::optional<Vec3> of_surface(std::int64_t i, std::int32_t surface) const;

 private:
  class Weight;
  struct Sum {
    double weight = 0;
    Vec3 moment = Vec3::Zero(); ///< about the point
  };
  template <class Add>
  Sum sum_over_own_part(std::int64_t i, Add&& add) const;

  const RestrictedVoronoi& voronoi_;
  const SizeField& size_;
};

} // namespace tessera::preprocess
