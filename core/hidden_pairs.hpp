/// Particles that are near each other in space but not in the body.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tessera {

/// Pairs that do not interact however near they are: a slot, a hole or a gap between two limbs lies between
/// them. Symmetric, in compressed rows.
class HiddenPairs {
 public:
  HiddenPairs() = default; ///< everybody sees everybody

  /// Among `particles` particles; `pairs` ascending, each once, 0 <= first < second < particles.
  HiddenPairs(std::int64_t particles, std::vector<std::array<std::int32_t, 2>> pairs)
      : pairs_(std::move(pairs)) {
    if (pairs_.empty())
      return;
    rows_.assign(static_cast<std::size_t>(particles + 1), 0);
    for (const auto& pair : pairs_)
      for (const std::int32_t a : pair)
        ++rows_[static_cast<std::size_t>(a) + 1];
    for (std::size_t a = 1; a < rows_.size(); ++a)
      rows_[a] += rows_[a - 1];
    columns_.resize(2 * pairs_.size());
    std::vector<std::int64_t> fill(rows_.begin(), rows_.end() - 1);
    // Smaller partners first, so that each row ascends.
    for (const auto& [a, b] : pairs_)
      columns_[static_cast<std::size_t>(fill[static_cast<std::size_t>(b)]++)] = a;
    for (const auto& [a, b] : pairs_)
      columns_[static_cast<std::size_t>(fill[static_cast<std::size_t>(a)]++)] = b;
  }

  const std::vector<std::array<std::int32_t, 2>>& pairs() const { return pairs_; }

  /// Whether a cannot see somebody.
  bool any_of(std::int64_t a) const {
    const auto row = static_cast<std::size_t>(a);
    return !rows_.empty() && rows_[row] < rows_[row + 1];
  }

  bool contains(std::int64_t a, std::int32_t b) const {
    if (rows_.empty())
      return false;
    const auto row = static_cast<std::size_t>(a);
    return std::binary_search(columns_.begin() + rows_[row], columns_.begin() + rows_[row + 1], b);
  }

 private:
  std::vector<std::array<std::int32_t, 2>> pairs_;
  std::vector<std::int64_t> rows_;
  std::vector<std::int32_t> columns_;
};

} // namespace tessera
