#include "preprocess/voronoi/convex_cell.hpp"

#include <algorithm>

namespace tessera::preprocess {

void ConvexCell::clear() {
  vertices_.clear();
  loops_.clear();
  faces_.clear();
}

void ConvexCell::add_face(std::span<const std::int32_t> loop, std::int32_t label) {
  faces_.push_back({static_cast<std::int32_t>(loops_.size()), static_cast<std::int32_t>(loop.size()), label});
  loops_.insert(loops_.end(), loop.begin(), loop.end());
}

void ConvexCell::set_box(const Vec3& lower, const Vec3& upper) {
  clear();
  for (int corner = 0; corner < 8; ++corner)
    vertices_.emplace_back(corner & 1 ? upper.x() : lower.x(), corner & 2 ? upper.y() : lower.y(),
                           corner & 4 ? upper.z() : lower.z());
  add_face(std::array{0, 4, 6, 2}, -1);
  add_face(std::array{1, 3, 7, 5}, -2);
  add_face(std::array{0, 1, 5, 4}, -3);
  add_face(std::array{2, 6, 7, 3}, -4);
  add_face(std::array{0, 2, 3, 1}, lower_lid);
  add_face(std::array{4, 5, 7, 6}, upper_lid);
}

void ConvexCell::set_tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  vertices_.assign({a, b, c, d});
  loops_.clear();
  faces_.clear();
  add_face(std::array{1, 2, 3}, -1);
  add_face(std::array{0, 3, 2}, -2);
  add_face(std::array{0, 1, 3}, -3);
  add_face(std::array{0, 2, 1}, -4);
}

bool ConvexCell::clip(const Vec3& normal, const Vec3& point, std::int32_t label) {
  const std::size_t n = vertices_.size();
  height_.resize(n);
  bool any_lost = false, any_below = false;
  for (std::size_t v = 0; v < n; ++v) {
    const double height = normal.dot(vertices_[v] - point);
    height_[v] = height;
    any_lost |= height > 0;
    any_below |= height < 0;
  }
  if (!any_lost)
    return true;
  if (!any_below) {
    clear();
    return false;
  }

  next_vertices_.clear();
  renumbered_.resize(n);
  for (std::size_t v = 0; v < n; ++v) {
    if (height_[v] > 0)
      continue;
    renumbered_[v] = static_cast<std::int32_t>(next_vertices_.size());
    next_vertices_.push_back(vertices_[v]);
  }
  const auto first_new = static_cast<std::int32_t>(next_vertices_.size());

  crossings_.clear();
  cap_next_.clear();
  // Every cut edge is met twice, once from each of its two faces, and gets one vertex. The formula does not
  // change when both heights change sign and the ends swap, so the cell on the other side gets the same
  // point.
  const auto crossing = [&](std::int32_t kept, std::int32_t lost) {
    for (const Crossing& known : crossings_)
      if (known.kept == kept && known.lost == lost)
        return known.vertex;
    const auto vertex = static_cast<std::int32_t>(next_vertices_.size());
    const double s = height_[kept], t = height_[lost];
    const double whole = t - s;
    next_vertices_.push_back(vertices_[kept] * (t / whole) - vertices_[lost] * (s / whole));
    crossings_.push_back({kept, lost, vertex});
    cap_next_.push_back(-1);
    return vertex;
  };

  next_loops_.clear();
  next_faces_.clear();
  for (const Face& face : faces_) {
    const std::int32_t* loop = loops_.data() + face.begin;
    const auto begin = static_cast<std::int32_t>(next_loops_.size());
    std::int32_t before = loop[face.size - 1];
    bool before_kept = !(height_[before] > 0);
    std::int32_t left_at = -1, first_entry = -1;
    for (std::int32_t k = 0; k < face.size; ++k) {
      const std::int32_t here = loop[k];
      const bool kept = !(height_[here] > 0);
      if (kept != before_kept) {
        if (before_kept) {
          left_at = crossing(before, here);
          next_loops_.push_back(left_at);
        } else {
          const std::int32_t entry = crossing(here, before);
          next_loops_.push_back(entry);
          // The face runs left_at -> entry along the plane; the cap runs back.
          if (left_at < 0)
            first_entry = entry;
          else
            cap_next_[entry - first_new] = left_at;
          left_at = -1;
        }
      }
      if (kept)
        next_loops_.push_back(renumbered_[here]);
      before = here;
      before_kept = kept;
    }
    if (first_entry >= 0)
      cap_next_[first_entry - first_new] = left_at;
    const auto size = static_cast<std::int32_t>(next_loops_.size()) - begin;
    if (size > 0)
      next_faces_.push_back({begin, size, face.label});
  }
  close_caps(first_new, label);
  vertices_.swap(next_vertices_);
  loops_.swap(next_loops_);
  faces_.swap(next_faces_);
  return true;
}

void ConvexCell::close_caps(std::int32_t first_new, std::int32_t label) {
  // A convex body has one cap; rounding can leave several, and each is closed on its own.
  for (std::size_t start = 0; start < cap_next_.size(); ++start) {
    if (cap_next_[start] < 0)
      continue;
    const auto begin = static_cast<std::int32_t>(next_loops_.size());
    auto at = static_cast<std::int32_t>(start) + first_new;
    while (cap_next_[at - first_new] >= 0) {
      next_loops_.push_back(at);
      const std::int32_t next = cap_next_[at - first_new];
      cap_next_[at - first_new] = -1;
      at = next;
    }
    next_faces_.push_back({begin, static_cast<std::int32_t>(next_loops_.size()) - begin, label});
  }
}

double ConvexCell::squared_radius(const Vec3& centre) const {
  double largest = 0;
  for (const Vec3& v : vertices_)
    largest = std::max(largest, (v - centre).squaredNorm());
  return largest;
}

ConvexCell::Measure ConvexCell::measure(const Vec3& origin) const {
  Measure result;
  for (const Face& face : faces_) {
    const auto points = loop(face);
    const Vec3 p = vertices_[points[0]] - origin;
    for (std::size_t k = 2; k < points.size(); ++k) {
      const Vec3 q = vertices_[points[k - 1]] - origin;
      const Vec3 r = vertices_[points[k]] - origin;
      const double sixfold = p.dot((q - p).cross(r - p));
      result.volume += sixfold;
      result.moment += sixfold * (p + q + r);
    }
  }
  result.volume /= 6;
  result.moment /= 24;
  return result;
}

Vec3 ConvexCell::area(const Face& face) const {
  const auto points = loop(face);
  const Vec3& p = vertices_[points[0]];
  Vec3 twice = Vec3::Zero();
  for (std::size_t k = 2; k < points.size(); ++k)
    twice += (vertices_[points[k - 1]] - p).cross(vertices_[points[k]] - p);
  return 0.5 * twice;
}

void ConvexCell::corners(std::vector<Corner>& out) const {
  out.assign(vertices_.size(), Corner{{0, 0, 0}, 0});
  for (const Face& face : faces_)
    for (const std::int32_t v : loop(face)) {
      Corner& corner = out[v];
      if (corner.count < 3)
        corner.labels[corner.count] = face.label;
      ++corner.count;
    }
}

} // namespace tessera::preprocess
