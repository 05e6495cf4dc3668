#include "preprocess/geometry/stl.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

namespace tessera::preprocess {
namespace {

InputError unreadable(const std::string& what, const std::string& origin) {
  return InputError(what, origin, "export the STL file again");
}

/// Three corners a triangle, as they stand in the file.
std::vector<Vec3> binary_corners(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  std::vector<Vec3> corners;
  corners.reserve(3 * std::size_t{count});
  for (std::size_t t = 0; t < count; ++t)
    for (int v = 0; v < 3; ++v) {
      float xyz[3];
      std::memcpy(xyz, bytes.data() + 84 + 50 * t + 12 * (v + 1), sizeof xyz);
      corners.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
  return corners;
}

class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  std::string_view next() {
    const auto first = text_.find_first_not_of(" \t\r\n", at_);
    if (first == std::string_view::npos) {
      at_ = text_.size();
      return {};
    }
    at_ = std::min(text_.find_first_of(" \t\r\n", first), text_.size());
    return text_.substr(first, at_ - first);
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

bool same_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](unsigned char a, char b) { return std::tolower(a) == b; });
}

std::vector<Vec3> text_corners(std::string_view text, const std::string& origin) {
  Words words(text);
  std::vector<Vec3> corners;
  bool ended = false;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (same_word(word, "solid")) {
      words.skip_line(); // its name is free text
      ended = false;
    } else if (same_word(word, "endsolid")) {
      words.skip_line();
      ended = true;
    } else if (same_word(word, "vertex")) {
      Vec3 X;
      for (int c = 0; c < 3; ++c) {
        std::string_view number = words.next();
        if (number.starts_with('+'))
          number.remove_prefix(1);
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), X[c]);
        if (error != std::errc{} || end != number.data() + number.size())
          throw unreadable(fmt::format("\"{}\" is not a coordinate", number), origin);
      }
      corners.push_back(X);
    }
  }
  if (!ended)
    throw unreadable("the STL file is cut off: its closing endsolid is missing", origin);
  if (corners.size() % 3 != 0)
    throw unreadable("the STL file has a triangle without three corners", origin);
  return corners;
}

struct Cell {
  std::int64_t i, j, k;
  bool operator==(const Cell&) const = default;
};
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    auto h = static_cast<std::uint64_t>(c.i) * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(c.j)) * 0xBF58476D1CE4E5B9ull;
    h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(c.k)) * 0x94D049BB133111EBull;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }
};

/// Gives each corner the number of the first corner within `tolerance` of it.
Triangles weld(const std::vector<Vec3>& corners, const Vec3& lower, double tolerance) {
  Triangles surface;
  std::unordered_map<Cell, std::vector<std::int32_t>, CellHash> grid;
  const auto cell_of = [&](const Vec3& X) {
    const Vec3 s = (X - lower) / (2 * tolerance);
    return Cell{static_cast<std::int64_t>(std::floor(s[0])), static_cast<std::int64_t>(std::floor(s[1])),
                static_cast<std::int64_t>(std::floor(s[2]))};
  };
  const auto number = [&](const Vec3& X) {
    const Cell home = cell_of(X);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto it = grid.find({home.i + i, home.j + j, home.k + k});
          if (it == grid.end())
            continue;
          for (const std::int32_t v : it->second)
            if ((surface.vertices[v] - X).norm() <= tolerance)
              return v;
        }
    const auto v = static_cast<std::int32_t>(surface.vertices.size());
    surface.vertices.push_back(X);
    grid[home].push_back(v);
    return v;
  };
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
    const Triangle t{number(corners[c]), number(corners[c + 1]), number(corners[c + 2])};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
      surface.triangles.push_back(t);
  }
  return surface;
}

} // namespace

Triangles read_stl(std::string_view bytes, const std::string& origin) {
  // A binary file may begin with "solid" too; its length tells. Its length is exact: 84 bytes and 50 a
  // triangle.
  std::uint32_t count = 0;
  if (bytes.size() >= 84)
    std::memcpy(&count, bytes.data() + 80, sizeof count);
  const std::size_t binary_size = 84 + 50 * std::size_t{count};
  const auto first = bytes.find_first_not_of(" \t\r\n");
  const bool text = first != std::string_view::npos && bytes.size() - first >= 5 &&
                    same_word(bytes.substr(first, 5), "solid") &&
                    bytes.find("facet") != std::string_view::npos;
  std::vector<Vec3> corners;
  if (bytes.size() >= 84 && bytes.size() == binary_size)
    corners = binary_corners(bytes);
  else if (text)
    corners = text_corners(bytes, origin);
  else if (bytes.size() >= 84 && bytes.size() > binary_size && count > 0)
    corners = binary_corners(bytes); // some exporters pad the end
  else
    throw unreadable(bytes.size() < 84
                         ? "the file is too short to be an STL file"
                         : fmt::format("the STL file is cut off: {} triangles announced, {} there", count,
                                       (bytes.size() - 84) / 50),
                     origin);
  if (corners.empty())
    throw unreadable("the STL file has no triangles", origin);

  Vec3 lower = corners[0], upper = corners[0];
  for (const Vec3& X : corners) {
    if (!X.allFinite())
      throw unreadable("the STL file has a coordinate that is not a number", origin);
    lower = lower.cwiseMin(X);
    upper = upper.cwiseMax(X);
  }
  const double diagonal = (upper - lower).norm();
  if (!(diagonal > 0))
    throw unreadable("the STL file has no extent", origin);
  return weld(corners, lower, 1e-7 * diagonal);
}

void close_and_orient(Triangles& surface, const std::string& origin) {
  const auto unpaired = unpaired_edges(surface.triangles);
  if (!unpaired.empty()) {
    const Vec3 X = (surface.vertices[unpaired[0][0]] + surface.vertices[unpaired[0][1]]) / 2;
    throw InputError(
        fmt::format("the STL surface is open or overlaps itself: {} of its edges {} not have exactly two "
                    "triangles, the first near ({:.6g}, {:.6g}, {:.6g}) in the file's unit",
                    unpaired.size(), unpaired.size() == 1 ? "does" : "do", X[0], X[1], X[2]),
        origin, "close the surface and export it again");
  }
  require(orient(surface.triangles), "the STL surface has only one side", origin, "repair the surface");

  const auto shells = shells_of(surface.triangles);
  const auto volumes = shell_volumes(surface.vertices, surface.triangles, shells);
  std::vector<std::vector<Triangle>> of_shell(volumes.size());
  for (std::size_t t = 0; t < shells.size(); ++t)
    of_shell[shells[t]].push_back(surface.triangles[t]);
  std::vector<int> depth(volumes.size(), 0); // in how many other shells it lies
  for (std::size_t s = 0; s < volumes.size(); ++s)
    for (std::size_t o = 0; o < volumes.size(); ++o)
      if (o != s && winding(surface.vertices, of_shell[o], surface.vertices[of_shell[s][0][0]]) != 0)
        ++depth[s];
  const auto solids = std::count_if(depth.begin(), depth.end(), [](int d) { return d % 2 == 0; });
  require(solids == 1, fmt::format("the file holds {} separate bodies", solids), origin,
          "give each body its own file");
  for (std::size_t t = 0; t < shells.size(); ++t)
    if ((volumes[shells[t]] > 0) != (depth[shells[t]] % 2 == 0))
      std::swap(surface.triangles[t][1], surface.triangles[t][2]);
}

} // namespace tessera::preprocess
