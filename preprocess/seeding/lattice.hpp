/// Regular lattices of a body.
#pragma once

#include "preprocess/voronoi/cad_topology.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Points within this fraction of the spacing of the boundary count as on it, inside or out.
inline constexpr double lattice_band = 0.02;

/// In the plane, cubic means square, hexagonal means triangular rows; body-centred is for bodies only.
/// Hexagonal in space is the close packing of layers ABAB.
enum class LatticeKind { cubic, body_centred, hexagonal };

/// Rows of nearest neighbours run along x; a hexagonal lattice's layers are stacked along z.
struct LatticeSpec {
  LatticeKind kind = LatticeKind::cubic;
  double spacing = 0; ///< m: distance between nearest neighbours, whatever the kind
  /// How far the lattice is moved from where it lies centred in the bounding box, in its periods along each
  /// axis. Half a period keeps a symmetric body's lattice symmetric.
  Vec3 shift = Vec3::Zero();
};

struct Lattice {
  LatticeSpec spec;
  Vec3 origin = Vec3::Zero();           ///< m, of index (0, 0, 0); z = 0 in the plane
  Vec3 unit = Vec3::Zero();             ///< m, of one step of the index along each axis
  std::array<std::int32_t, 3> counts{}; ///< of indices along each axis of the bounding box
  /// The lattice is a union of rectangular ones. Cubic: all indices. Body-centred: units of half the cube's
  /// side, all even or all odd. Hexagonal: units of (spacing/2, spacing/sqrt(12), spacing sqrt(2/3)), rows
  /// every three of them along y and odd layers two of them aside.
  std::vector<std::array<std::int32_t, 3>> index;
  std::vector<CadPlace> place; ///< by nearness to the CAD entities, within the band

  Vec3 position(std::size_t i) const {
    return origin + unit.cwiseProduct(Vec3(index[i][0], index[i][1], index[i][2]));
  }
  /// The same lattice turned and scaled so that all coordinates are whole numbers: points on one sphere are
  /// so exactly, which makes a Delaunay triangulation fast and symmetric. In the plane the points stay in one
  /// plane, z = 0 for the cubic kind only.
  Vec3 whole_numbers(std::size_t i) const;
};

/// Where the lattice of a bounding box lies: as many steps as fit along each axis, centred, so that a box
/// whose sides are multiples of the step has points on all its faces. InputError: body-centred in the plane.
Lattice lattice_frame(const Domain& domain, const LatticeSpec& spec);

/// The lattice points inside the body or within the band of its boundary.
///
/// Columns along z: where a column crosses the boundary triangles is decided by exact orientations with
/// consistent tie breaking, so it crosses a closed surface an even number of times. Around facets that
/// approximate a curved face the band is at least their chordal error (capped at a quarter of the spacing).
Lattice lattice_points(const Domain& domain, const CadTopology& cad, const LatticeSpec& spec);

/// How many points lattice_points would give.
std::int64_t lattice_count(const Domain& domain, const CadTopology& cad, const LatticeSpec& spec);

struct FittedLattice {
  LatticeSpec spec;
  std::int64_t count = 0; ///< its points
};

/// The lattice of `kind` with `count` points within 2 %, or as near as one comes. In this order of
/// preference, each only where the ones before miss the 2 %: the spacing divides a side of the bounding box
/// (points on both of its faces), any spacing, half a period of shift along some axes, any shift.
///
/// Small boxes cannot do better: along a side of k spacings lie k or k + 1 points, so the counts of a cube
/// with a cubic lattice are k^a (k + 1)^(3 - a) and, but for what the band adds, nothing between: up to 1/2k
/// away from what was asked.
FittedLattice lattice_for_count(const Domain& domain, const CadTopology& cad, LatticeKind kind,
                                std::int64_t count);

} // namespace tessera::preprocess
