#include "preprocess/geometry/weld.hpp"

#include <cmath>
#include <unordered_map>

namespace tessera::preprocess {
namespace {

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

} // namespace

std::vector<std::int32_t> weld(std::span<const Vec3> points, double tolerance) {
  std::vector<std::int32_t> first(points.size());
  if (points.empty())
    return first;
  Vec3 lower = points[0];
  for (const Vec3& X : points)
    lower = lower.cwiseMin(X);
  std::unordered_map<Cell, std::vector<std::int32_t>, CellHash> grid; // of those that stand for themselves
  const auto number = [&](std::int32_t p) {
    const Vec3 s = (points[p] - lower) / (2 * tolerance);
    const Cell home{static_cast<std::int64_t>(std::floor(s[0])), static_cast<std::int64_t>(std::floor(s[1])),
                    static_cast<std::int64_t>(std::floor(s[2]))};
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto it = grid.find({home.i + i, home.j + j, home.k + k});
          if (it == grid.end())
            continue;
          for (const std::int32_t q : it->second)
            if ((points[q] - points[p]).norm() <= tolerance)
              return q;
        }
    grid[home].push_back(p);
    return p;
  };
  for (std::size_t p = 0; p < points.size(); ++p)
    first[p] = number(static_cast<std::int32_t>(p));
  return first;
}

} // namespace tessera::preprocess
