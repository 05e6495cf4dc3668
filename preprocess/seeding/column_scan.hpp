/// The points of a rectangular lattice in or on a body, column by column along z.
#pragma once

#include "preprocess/seeding/lattice.hpp"
#include "preprocess/seeding/orientation.hpp"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace tessera::preprocess {

/// One of the rectangular lattices whose union is a Lattice: the indices first + step * i.
struct Sublattice {
  std::array<std::int32_t, 3> first, step;
};

/// What every scan of one body needs to know of its boundary.
class BoundaryBands {
 public:
  BoundaryBands(const Domain& domain, const CadTopology& cad);

  const Domain& domain() const { return domain_; }
  const CadTopology& cad() const { return cad_; }
  const Vec3& normal(std::int32_t facet) const { return normals_[facet]; }
  std::array<Vec3, 3> corners(std::int32_t facet) const;

  /// How far the curved face can bulge over a facet, or the curved rim of a slab over its piece `edge`, m.
  double bulge(std::int32_t facet) const { return bulge_[facet]; }
  double rim_bulge(std::int32_t edge) const { return rim_bulge_[edge]; }

 private:
  double facet_bulge(std::int32_t facet) const;
  void find_rim_bulges();

  const Domain& domain_;
  const CadTopology& cad_;
  std::vector<Vec3> normals_;     ///< by facet
  std::vector<double> bulge_;     ///< by facet; empty in a slab
  std::vector<double> rim_bulge_; ///< by feature edge; only in a slab
};

/// How many points the lattice has in or on the body of `bands`.
std::int64_t lattice_count(const BoundaryBands& bands, const LatticeSpec& spec);

/// The columns of a rectangular lattice: where each enters and leaves the body, and the points of the
/// boundary's band.
class ColumnScan {
 public:
  ColumnScan(const BoundaryBands& bands, const Lattice& frame, const Sublattice& part);

  std::int64_t count() const;
  void emit(Lattice& lattice) const; ///< appends index and place

 private:
  using Run = std::pair<std::int32_t, std::int32_t>; ///< first and last layer
  /// A lattice point on the boundary, by its place in the scan: column * layers + layer.
  struct OnBoundary {
    std::int64_t key;
    CadPlace place;
  };

  double at(int axis, std::int64_t i) const {
    return frame_.origin[axis] +
           frame_.unit[axis] * static_cast<double>(part_.first[axis] + part_.step[axis] * i);
  }
  Run range(int axis, double low, double high) const;
  double band(double bulge) const;
  void cross(const std::array<Vec3, 3>& X);
  void mark_facet(std::int32_t facet);
  void mark_rim(std::int32_t edge);
  void mark(const std::array<std::int32_t, 3>& index, const CadPlace& place);
  CadPlace place(const Vec3& p, std::int32_t facet, const std::array<Vec3, 3>& X, double band) const;
  void sort_crossings();
  void sort_band();
  template <class Visit>
  void each_column(Visit&& visit) const;

  const BoundaryBands& bands_;
  const Lattice& frame_;
  Sublattice part_;
  std::array<std::int32_t, 3> counts_; ///< of this part
  std::int64_t columns_;
  std::vector<std::pair<std::int64_t, double>> crossings_; ///< column, height
  std::vector<std::int64_t> rows_;
  std::vector<double> heights_;
  std::vector<OnBoundary> band_;
};

} // namespace tessera::preprocess
