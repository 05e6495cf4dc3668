#include "preprocess/cloud/renumber.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tessera::preprocess {
namespace {

constexpr int bits = 21;

/// Place of a cell on the Hilbert curve (Skilling, Programming the Hilbert curve, 2004: axes to transpose).
std::uint64_t place_on_curve(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (int a = 0; a < 3; ++a)
      if (x[a] & q) {
        x[0] ^= below;
      } else {
        const std::uint32_t swap = (x[0] ^ x[a]) & below;
        x[0] ^= swap;
        x[a] ^= swap;
      }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flip = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1)
    if (x[2] & q)
      flip ^= q - 1;
  for (std::uint32_t& v : x)
    v ^= flip;
  std::uint64_t key = 0;
  for (int b = bits - 1; b >= 0; --b)
    for (const std::uint32_t v : x)
      key = key << 1 | (v >> b & 1);
  return key;
}

} // namespace

std::vector<std::int32_t> hilbert_order(const std::vector<Vec3>& points) {
  const auto n = static_cast<std::int64_t>(points.size());
  if (n == 0)
    return {};
  Vec3 lower = points[0], upper = points[0];
  for (const Vec3& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const double side = (upper - lower).maxCoeff();
  const double scale = side > 0 ? ((1u << bits) - 1) / side : 0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(n);
  for_each(n, [&](std::int64_t i) {
    std::array<std::uint32_t, 3> cell;
    for (int a = 0; a < 3; ++a)
      cell[a] = static_cast<std::uint32_t>((points[i][a] - lower[a]) * scale);
    keys[i] = {place_on_curve(cell), static_cast<std::int32_t>(i)};
  });
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(n);
  for (std::int64_t i = 0; i < n; ++i)
    order[i] = keys[i].second;
  return order;
}

} // namespace tessera::preprocess
