#include "solver/boundary/polyline.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::solver {
namespace {

using Point = Vec<2>;

double cross(const Point& a, const Point& b) {
  return a[0] * b[1] - a[1] * b[0];
}

Point left_of(const Point& along) {
  return {-along[1], along[0]};
}

/// The turn from one direction to the next, positive to the left, rad.
double angle_between(const Point& before, const Point& after) {
  return std::atan2(cross(before, after), before.dot(after));
}

/// Without what round-off leaves of a zero.
std::string text(const Point& x) {
  const auto clean = [&](double c) { return std::abs(c) < 1e-12 * x.norm() ? 0.0 : c; };
  return fmt::format("({:g}, {:g})", clean(x[0]), clean(x[1]));
}

/// Unit vectors along the pieces. InputError where they do not make a line.
std::vector<Point> directions(const std::vector<Point>& points, const std::string& where) {
  require(points.size() >= 2, fmt::format("a wall's line has {} points", points.size()), where,
          "give two or more");
  std::vector<Point> along;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    require(points[i].allFinite() && points[i + 1].allFinite(), "a point of a wall's line is not finite",
            where, "give its coordinates in metres");
    const Point step = points[i + 1] - points[i];
    require(step.norm() > 1e-12 * std::max(points[i].norm(), points[i + 1].norm()),
            fmt::format("point {} of a wall's line, {}, repeats the one before", i + 2, text(points[i + 1])),
            where, "leave it out");
    along.push_back(step.normalized());
    constexpr double straight_back = 1e-6; // rad
    require(i == 0 || M_PI - std::abs(angle_between(along[i - 1], along[i])) > straight_back,
            fmt::format("a wall's line turns back on itself at {}", text(points[i])), where,
            "let it turn by less than 180 degrees");
  }
  return along;
}

} // namespace

Polyline::Polyline(const std::vector<Vec<2>>& points, std::vector<double> fillets, const std::string& where) {
  const std::vector<Point> along = directions(points, where);
  const std::size_t inner = points.size() - 2;
  if (fillets.empty())
    fillets.assign(inner, 0);
  require(fillets.size() == inner,
          fmt::format("a wall's line of {} points lists {} fillets", points.size(), fillets.size()), where,
          fmt::format("give one for each of its {} inner points, 0 where the corner is sharp", inner));

  segments_.resize(along.size());
  for (std::size_t i = 0; i < along.size(); ++i)
    segments_[i] = {points[i], along[i]};
  std::vector<double> used(along.size(), 0); // of each piece's length, by the fillets at its ends
  for (std::size_t i = 0; i < inner; ++i) {
    const double radius = fillets[i], turn = angle_between(along[i], along[i + 1]);
    require(std::isfinite(radius) && radius >= 0, fmt::format("a fillet of a wall's line is {:g}", radius),
            where, "give a radius in metres, 0 where the corner is sharp");
    const Point corner = points[i + 1];
    const double length = (corner - points[i]).norm(), side = turn > 0 ? 1 : -1;
    const double tangent = radius * std::tan(std::abs(turn) / 2); // from the corner to where the arc begins
    for (const std::size_t piece : {i, i + 1}) {
      used[piece] += tangent;
      const double whole = (points[piece + 1] - points[piece]).norm();
      require(used[piece] <= whole * (1 + 1e-9),
              fmt::format("the fillet of {:g} m at {} does not fit: the piece of {:g} m beside it would need "
                          "{:g} m",
                          radius, text(corner), whole, used[piece]),
              where, "take smaller fillets or longer pieces");
    }
    segments_[i].to = length - tangent;
    segments_[i + 1].from = tangent;
    if (tangent > 0) {
      const Point first = corner - tangent * along[i], last = corner + tangent * along[i + 1];
      const Point centre = first + side * radius * left_of(along[i]);
      arcs_.push_back({centre, -side * left_of(along[i]), -side * left_of(along[i + 1]), radius, side});
      joints_.push_back({first, left_of(along[i])});
      joints_.push_back({last, left_of(along[i + 1])});
    } else {
      joints_.push_back({corner, left_of(along[i] + along[i + 1]).normalized()});
    }
  }
  refuse_crossings(where);
}

void Polyline::refuse_crossings(const std::string& where) const {
  for (std::size_t i = 0; i < segments_.size(); ++i)
    for (std::size_t j = i + 2; j < segments_.size(); ++j) {
      const Segment &a = segments_[i], &b = segments_[j];
      const Point apart = b.origin - a.origin;
      const double sine = cross(a.along, b.along);
      bool meet = false;
      if (std::abs(sine) > 1e-12) {
        const double s = cross(apart, b.along) / sine, t = cross(apart, a.along) / sine;
        meet = s >= a.from && s <= a.to && t >= b.from && t <= b.to;
      } else if (std::abs(cross(a.along, apart)) <= 1e-12 * apart.norm()) {
        const double same = a.along.dot(b.along), start = a.along.dot(apart);
        const double one = start + same * b.from, other = start + same * b.to;
        meet = std::max(std::min(one, other), a.from) <= std::min(std::max(one, other), a.to);
      }
      require(!meet,
              fmt::format("pieces {} and {} of a wall's line cross, or would once its ends are prolonged",
                          i + 1, j + 1),
              where, "its first and last pieces go on for ever: add points that lead them apart");
    }
}

std::vector<Vec<2>> Polyline::drawn(double reach) const {
  constexpr double step = 5 * M_PI / 180;
  std::vector<Point> points;
  auto arc = arcs_.begin();
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& segment = segments_[i];
    const bool first = i == 0, last = i + 1 == segments_.size();
    if (first)
      points.push_back(segment.origin - reach * segment.along);
    points.push_back(segment.origin +
                     (last ? (first ? 0 : segment.from) + reach : segment.to) * segment.along);
    if (last || segments_[i + 1].from == 0)
      continue;
    const double turn = std::atan2(cross(arc->first, arc->last), arc->first.dot(arc->last));
    const int steps = static_cast<int>(std::ceil(std::abs(turn) / step));
    for (int k = 1; k <= steps; ++k)
      points.push_back(arc->centre + arc->radius * (Eigen::Rotation2Dd(turn * k / steps) * arc->first));
    ++arc;
  }
  return points;
}

RigidShape::Gap Polyline::gap(const Vec3& x) const {
  const Point at = x.head<2>();
  double best = std::numeric_limits<double>::infinity(), distance = best;
  Point normal = Point::Zero();
  const auto offer = [&](double signed_distance, const Point& n) {
    if (std::abs(signed_distance) < best) {
      best = std::abs(signed_distance);
      distance = signed_distance;
      normal = n;
    }
  };
  for (const Segment& segment : segments_) {
    const Point from = at - segment.origin;
    const double t = segment.along.dot(from);
    if (t >= segment.from && t <= segment.to)
      offer(cross(segment.along, from), left_of(segment.along));
  }
  for (const Arc& arc : arcs_) {
    const Point from = at - arc.centre;
    if (arc.turn * cross(arc.first, from) >= 0 && arc.turn * cross(from, arc.last) >= 0) {
      const double r = from.norm();
      offer(arc.turn * (arc.radius - r), r > 0 ? Point(-arc.turn / r * from) : Point(-arc.turn * arc.first));
    }
  }
  // Nearest is a corner or, within round-off, where an arc begins.
  for (const Joint& joint : joints_) {
    const Point from = at - joint.at;
    const double r = from.norm();
    if (r < best) {
      const double side = joint.normal.dot(from) < 0 ? -1 : 1;
      offer(side * r, r > 0 ? Point(side / r * from) : joint.normal);
    }
  }
  return {distance, {normal[0], normal[1], 0}};
}

Channel channel(const std::vector<Vec<2>>& path, double width, double outer_fillet, double inner_fillet,
                const std::string& where) {
  require(std::isfinite(width) && width > 0, fmt::format("a channel is {:g} m wide", width), where,
          "give it a positive width");
  const std::vector<Point> along = directions(path, where);
  // The side of a path, to the left (1) or to the right (-1).
  const auto side = [&](double hand) {
    std::vector<Point> points;
    std::vector<double> fillets;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Point before = along[i == 0 ? 0 : i - 1], after = along[std::min(i, along.size() - 1)];
      const double turn = angle_between(before, after);
      const Point outwards = hand * left_of(before + after).normalized();
      points.push_back(path[i] + width / 2 / std::cos(turn / 2) * outwards);
      if (i > 0 && i + 1 < path.size())
        fillets.push_back(turn * hand > 0 ? inner_fillet : outer_fillet);
      require(i == 0 || along[i - 1].dot(points[i] - points[i - 1]) > 0,
              fmt::format("a channel {:g} m wide does not fit the path's piece of {:g} m to {}", width,
                          (path[i] - path[i - 1]).norm(), text(path[i])),
              where, "make it narrower or the path's pieces longer");
    }
    if (hand > 0) { // drawn backwards it has the channel on its left
      std::reverse(points.begin(), points.end());
      std::reverse(fillets.begin(), fillets.end());
    }
    return std::make_shared<const Polyline>(points, std::move(fillets), where);
  };
  return {side(1), side(-1)};
}

} // namespace tessera::solver
