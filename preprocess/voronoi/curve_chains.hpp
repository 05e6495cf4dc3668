/// The CAD curves of a body as chains of mesh edges, and particles spread evenly along them.
#pragma once

#include "preprocess/seeding/size_field.hpp"
#include "preprocess/voronoi/tet_body.hpp"
#include "preprocess/voronoi/vertices.hpp"

#include <cstdint>
#include <vector>

namespace tessera::preprocess {

class CurveChains {
 public:
  /// In the body's scaled coordinates, z = 0 in a slab.
  CurveChains(const TetBody& body, const CadTopology& cad, const SizeField& size);

  /// Moves the particles of every curve along it until they lie evenly by the size field, between corners or
  /// round closed curves: where Lloyd's sweeps along a curve would end.
  void spread(PlacedPoints& particles) const;

 private:
  /// An unbranched piece of one curve, from corner to corner or closed.
  struct Chain {
    std::int32_t curve;
    bool closed;
    bool starts_at_corner, ends_at_corner;
    std::vector<Vec3> points;
    std::vector<double> length_up_to; ///< at each point, in units of the size field
  };
  struct Found {
    std::int32_t chain;
    double at; ///< length along it
  };

  void add_chain(const TetBody& body, const CadTopology& cad, const SizeField& size, std::int32_t curve,
                 const std::vector<std::int32_t>& vertices);
  Found find(const Vec3& x, std::int32_t curve) const;
  static Vec3 point_at(const Chain& chain, double length);

  std::vector<Chain> chains_;
  std::vector<std::vector<std::int32_t>> chains_of_; ///< by curve
};

} // namespace tessera::preprocess
