/// Faces where one triangulation ends and another has to go on.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace tessera::preprocess {

/// Three vertices in ascending order, and whether the face turned over when they were sorted: seen from the
/// same side it has the same `turned`.
struct OrientedFace {
  std::array<std::int32_t, 3> vertices;
  bool turned = false;

  explicit OrientedFace(const std::array<std::int32_t, 3>& seen) : vertices(seen) {
    const auto order = [this](int a, int b) {
      if (vertices[a] > vertices[b]) {
        std::swap(vertices[a], vertices[b]);
        turned = !turned;
      }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
  }
};

/// A set of faces to look up.
class Rim {
 public:
  enum class Side { none, inner, outer }; ///< not in the set; seen as in the set; seen from behind

  explicit Rim(const std::vector<OrientedFace>& faces) : faces_(faces) {
    std::size_t places = 16;
    while (places < 2 * faces.size())
      places *= 2;
    table_.assign(places, -1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::size_t at = place(faces[f]);
      while (table_[at] >= 0)
        at = (at + 1) & (table_.size() - 1);
      table_[at] = static_cast<std::int32_t>(f);
    }
  }

  Side side(const OrientedFace& face) const {
    for (std::size_t at = place(face); table_[at] >= 0; at = (at + 1) & (table_.size() - 1)) {
      const OrientedFace& known = faces_[static_cast<std::size_t>(table_[at])];
      if (known.vertices == face.vertices)
        return known.turned == face.turned ? Side::inner : Side::outer;
    }
    return Side::none;
  }

 private:
  std::size_t place(const OrientedFace& face) const {
    std::uint64_t h = 0;
    for (const std::int32_t v : face.vertices) {
      h = (h ^ static_cast<std::uint32_t>(v)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return h & (table_.size() - 1);
  }

  const std::vector<OrientedFace>& faces_;
  std::vector<std::int32_t> table_;
};

} // namespace tessera::preprocess
