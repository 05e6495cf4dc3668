/// Points nearer to each other than a radius become one, CAD model respected.
#pragma once

#include "preprocess/voronoi/vertices.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// Distance that a point at `later` keeps from one at `kept`, as a fraction of its radius. A point of a curve
/// yields to its corners and to points of the same curve, one of a surface to that surface's corners, curves
/// and points, an inner one to all. Beyond that, points of two curves that share a corner and of two surfaces
/// that share a curve keep 0.8 radius between them; the two sides of a thin plate or slot owe each other
/// nothing.
double claim(const CadTopology& cad, int dimension, const CadPlace& kept, const CadPlace& later);

/// Points that keep their distance, each with a radius of its own.
class KeptPoints {
 public:
  /// For a body of the given dimension; all radii lie in [smallest, largest], both positive.
  KeptPoints(const CadTopology& cad, int dimension, double smallest, double largest);

  const PlacedPoints& points() const { return points_; }
  PlacedPoints take() { return std::move(points_); }

  void add(const Vec3& x, const CadPlace& place);

  /// Whether no point is nearer than it may be to a later one with this radius. Points closer than 1e-9
  /// always are, except to corners, which have room anywhere.
  bool has_room(const Vec3& x, const CadPlace& place, double radius) const;

  /// Appends all points nearer to x than `reach`, ascending.
  void collect(const Vec3& x, double reach, std::vector<std::int32_t>& found) const;

 private:
  /// Points by the cube of a grid they lie in, hashed.
  struct Grid {
    double side;
    std::vector<std::int32_t> first; ///< by bucket
    std::vector<std::int32_t> next;  ///< by point
  };
  using Cube = std::array<std::int64_t, 3>;
  static Cube cube(const Grid& grid, const Vec3& x);
  static std::size_t bucket(const Grid& grid, const Cube& c);
  const Grid& grid_for(double reach) const;
  void insert(Grid& grid, std::int32_t point) const;
  void rehash(Grid& grid) const;
  template <class Test>
  bool any_near(const Vec3& x, double reach, Test&& test) const;

  const CadTopology* cad_;
  int dimension_;
  PlacedPoints points_;
  std::vector<Grid> grids_; ///< finest first, sides doubling up to the largest radius
};

/// Keeps greedily, in the given order (lower dimensions first), each point that has room among those kept.
/// One radius for all, or one for each point.
PlacedPoints merged(const PlacedPoints& points, const CadTopology& cad, double radius, int dimension = 3);
PlacedPoints merged(const PlacedPoints& points, const CadTopology& cad, const std::vector<double>& radii,
                    int dimension);

} // namespace tessera::preprocess
