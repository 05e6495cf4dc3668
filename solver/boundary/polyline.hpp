/// Plane tools drawn by a line: straight pieces with rounded or sharp corners, and channels between two.
#pragma once

#include "core/rigid_shape.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace tessera::solver {

/// The free side is on the left of the line as it is drawn; its first and last pieces go on for ever.
class Polyline final : public RigidShape {
 public:
  /// `points`: two or more, m. `fillets`: the radius of the arc that rounds each inner point (m), 0 where the
  /// corner is sharp; empty: all are.
  /// InputError, naming `where`, on points that repeat, a piece that turns back on the one before, a fillet
  /// longer than its pieces, and a line that crosses itself or would once its ends are prolonged.
  Polyline(const std::vector<Vec<2>>& points, std::vector<double> fillets, const std::string& where = "");

  Gap gap(const Vec3& x) const override;

  /// Points along the line, arcs in steps of 5 degrees or less, both ends prolonged by `reach` (m).
  std::vector<Vec<2>> drawn(double reach) const;

 private:
  /// origin + t along for t in [from, to].
  struct Segment {
    Vec<2> origin, along; ///< along of unit length
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  };
  struct Arc {
    Vec<2> centre, first, last; ///< unit vectors from the centre to its ends
    double radius;
    double turn; ///< 1: to the left, the centre is free; -1: to the right
  };
  /// Where two pieces meet, rounded or not.
  struct Joint {
    Vec<2> at, normal; ///< of unit length: the mean of the two pieces' normals
  };

  void refuse_crossings(const std::string& where) const;

  std::vector<Segment> segments_;
  std::vector<Arc> arcs_;
  std::vector<Joint> joints_;
};

/// The two sides of a channel.
struct Channel {
  std::shared_ptr<const Polyline> left, right; ///< as one goes along its path
};

/// The channel of constant `width` (m) around a path. Of each turn the outer side is rounded by
/// `outer_fillet` and the inner side by `inner_fillet` (m).
/// InputError, naming `where`, as of a Polyline, and where the path is too short for so wide a channel.
Channel channel(const std::vector<Vec<2>>& path, double width, double outer_fillet, double inner_fillet,
                const std::string& where = "");

} // namespace tessera::solver
