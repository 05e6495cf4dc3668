/// Where parts of a body are not covered by the balls around points: room for more.
#pragma once

#include "preprocess/seeding/body_boxes.hpp"

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

/// The edge of a simplex with the largest squared length, as its two corners.
struct LongestEdge {
  int a = 0, b = 1;
  double squared = 0;
  explicit LongestEdge(const Simplex& simplex);
};

/// A point already there, and which fraction of the radius at another place that one must keep from it.
struct Claimed {
  Vec3 x;
  double fraction;
};

/// Halves pieces of a body until each part lies in the ball of one claim or is smaller than `grain` radii
/// across. Of each part left over it takes a random point, or else the middle, if that lies in no ball. So
/// where nothing is taken, no point is farther out of the balls than a part reaches from its middle.
class VoidSearch {
 public:
  explicit VoidSearch(double grain) : grain_(grain) {}

  /// Appends the points found. `claims` must hold all whose balls may meet the piece. The same points for the
  /// same key.
  void run(const Simplex& simplex, const std::vector<Claimed>& claims, std::uint64_t key,
           std::vector<Vec3>& found);

  /// In the part of a cube inside the body; one radius, the least of it; all claims count in full.
  void run(const Cube& cube, double radius, const BodyBoxes& body, const std::vector<Claimed>& claims,
           std::uint64_t key, std::vector<Vec3>& found);

 private:
  void search(const Simplex& simplex, std::size_t begin, std::size_t end);
  void search(const Cube& cube, std::size_t begin, std::size_t end);
  bool covered(const Simplex& simplex, double least, std::size_t begin, std::size_t end) const;
  bool covered(const Cube& cube, std::size_t begin, std::size_t end) const;
  /// Puts those claims whose balls come nearer to the middle than `around` behind the rest.
  void narrow(const Vec3& middle, double around, double radius, std::size_t begin, std::size_t end);
  bool free(const Vec3& x, double radius, std::size_t begin, std::size_t end) const;
  double uniform();

  double grain_;
  std::uint64_t state_ = 0;
  std::vector<Claimed> claims_; ///< those that still matter, for each level of halving after one another
  std::vector<Vec3>* found_ = nullptr;
  double radius_ = 0;               ///< of a cube
  const BodyBoxes* body_ = nullptr; ///< of a cube
};

} // namespace tessera::preprocess
