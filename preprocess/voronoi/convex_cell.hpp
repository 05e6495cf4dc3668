/// A convex polyhedron that planes cut: the cell of a particle, or its part inside one tetrahedron.
#pragma once

#include "core/tensor.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera::preprocess {

/// Polyhedron as closed face loops, counter-clockwise seen from outside.
///
/// Each cut gives every vertex one sign (zero counts as kept) and all that follows is combinatorial: each
/// edge between a kept and a lost vertex gets one new vertex, and the new edges chain up to the cap. So the
/// loops stay closed whatever the rounding, and the opposite half-space keeps exactly what this one loses.
class ConvexCell {
 public:
  struct Face {
    std::int32_t begin; ///< into loops
    std::int32_t size;
    std::int32_t
        label; ///< what made it: the caller's numbers, negative ones for the starting body's own faces
  };
  struct Measure {
    double volume = 0;
    Vec3 moment = Vec3::Zero(); ///< integral of (x - origin)
  };

  /// What set_box labels the faces z = lower and z = upper: the lids of a plane cell.
  static constexpr std::int32_t lower_lid = -5, upper_lid = -6;

  /// Axis-aligned box; its faces carry the labels -1 ... -6, in the order x, y, z, lower ones first.
  void set_box(const Vec3& lower, const Vec3& upper);

  /// Tetrahedron of positive volume; the face opposite to corner k carries the label -1-k.
  void set_tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

  /// Any closed polyhedron, built up: begin with clear(), then its vertices, then its faces, loops
  /// counter-clockwise seen from outside.
  void clear();
  void add_vertex(const Vec3& x) { vertices_.push_back(x); }
  void add_face(std::span<const std::int32_t> loop, std::int32_t label);

  /// Keeps the part where normal.(x - point) <= 0; the new face carries `label`. False when nothing but
  /// points of the plane itself would be left: the cell is empty then.
  bool clip(const Vec3& normal, const Vec3& point, std::int32_t label);

  bool empty() const { return faces_.empty(); }

  /// Largest squared distance of a vertex from `centre`.
  double squared_radius(const Vec3& centre) const;

  /// Volume and first moment about `origin`, summed over fans of triangles seen from it.
  Measure measure(const Vec3& origin) const;

  Vec3 area(const Face& face) const; ///< outward area vector

  std::span<const Face> faces() const { return faces_; }
  std::span<const Vec3> vertices() const { return vertices_; }
  std::span<const std::int32_t> loop(const Face& face) const {
    return {loops_.data() + face.begin, static_cast<std::size_t>(face.size)};
  }

  /// The labels of the faces around each vertex: the first three of them, and how many there are.
  struct Corner {
    std::array<std::int32_t, 3> labels;
    std::int32_t count;
  };
  void corners(std::vector<Corner>& out) const;

 private:
  void close_caps(std::int32_t first_new, std::int32_t label);

  std::vector<Vec3> vertices_;
  std::vector<std::int32_t> loops_;
  std::vector<Face> faces_;

  // Room that every cut uses again, so that cutting allocates nothing once the vectors have grown.
  struct Crossing {
    std::int32_t kept, lost, vertex;
  };
  std::vector<double> height_;
  std::vector<std::int32_t> renumbered_;
  std::vector<Vec3> next_vertices_;
  std::vector<std::int32_t> next_loops_;
  std::vector<Face> next_faces_;
  std::vector<Crossing> crossings_;
  std::vector<std::int32_t> cap_next_;
};

} // namespace tessera::preprocess
