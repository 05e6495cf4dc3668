/// Where simplices are not covered by the balls around points: room for more.
#pragma once

#include "core/tensor.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Segment, triangle or tetrahedron with a radius at each corner, linear in between.
struct Simplex {
  int dimension;
  std::array<Vec3, 4> corners;
  std::array<double, 4> radius;
};

/// A point already there, and which fraction of the radius at another place that one must keep from it.
struct Claimed {
  Vec3 x;
  double fraction;
};

/// Halves a simplex across its longest edge until each part lies in the ball of one claim or is smaller than
/// `grain` radii. Of each part left over it takes a random point, or else the middle, if that lies in no
/// ball. So where nothing is taken, no point is farther out of the balls than a part reaches from its middle.
class VoidSearch {
 public:
  explicit VoidSearch(double grain) : grain_(grain) {}

  /// Appends the points found; `claims` must hold all whose balls may meet the simplex. The same points for
  /// the same key.
  void run(const Simplex& simplex, const std::vector<Claimed>& claims, std::uint64_t key,
           std::vector<Vec3>& found);

 private:
  void search(const Simplex& simplex, std::size_t begin, std::size_t end);
  bool covered(const Simplex& simplex, double least, std::size_t begin, std::size_t end) const;
  bool take(const Vec3& x, double radius, std::size_t begin, std::size_t end);
  double uniform();

  double grain_;
  std::uint64_t state_ = 0;
  std::vector<Claimed> claims_; ///< those that still matter, for each level of halving after one another
  std::vector<Vec3>* found_ = nullptr;
};

/// The edge of a simplex with the largest squared length, as its two corners.
struct LongestEdge {
  int a = 0, b = 1;
  double squared = 0;
  explicit LongestEdge(const Simplex& simplex);
};

} // namespace tessera::preprocess
