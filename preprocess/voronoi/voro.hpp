/// Voro++ as the second backend: its own search for neighbours and its own plane cuts.
///
/// Voro++ (Rycroft 2009) tells points from planes by an absolute 1e-11. The body's scaled coordinates
/// (spacing about 1) are handed over eight times as large: there that is 1e-13 of a cell, and still far above
/// rounding.
#pragma once

#include "preprocess/voronoi/convex_cell.hpp"
#include "preprocess/voronoi/delaunay.hpp"
#include "preprocess/voronoi/tet_body.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tessera::preprocess {

/// Neighbours that share a Voronoi face within the bounding box of the body and the seeds, nearest first
/// (ties by index); both directions of each. InputError where two seeds coincide.
DelaunayGraph voro_neighbours(const TetBody& body, const std::vector<Vec3>& seeds);

/// A cell cut by Voro++.
class VoroCell {
 public:
  VoroCell();
  ~VoroCell();
  VoroCell(const VoroCell&) = delete;
  VoroCell& operator=(const VoroCell&) = delete;

  /// The box, cut by the bisectors between `seed` and its neighbours (nearest first), labelled as ConvexCell
  /// labels them.
  void cut_box(const Vec3& lower, const Vec3& upper, const std::vector<Vec3>& seeds, std::int64_t seed,
               std::span<const std::int32_t> neighbours, ConvexCell& result);

  /// The tetrahedron of positive volume, cut likewise; false: nothing is left.
  bool cut_tetrahedron(const std::array<Vec3, 4>& corners, const std::vector<Vec3>& seeds, std::int64_t seed,
                       std::span<const std::int32_t> neighbours, ConvexCell& result);

 private:
  struct Cell;
  bool cut(const std::vector<Vec3>& seeds, std::int64_t seed, std::span<const std::int32_t> neighbours,
           ConvexCell& result);
  std::unique_ptr<Cell> cell_;
};

} // namespace tessera::preprocess
