/// Who interacts with whom: a symmetric relation fixed in the reference configuration.
#pragma once

#include "core/hidden_pairs.hpp"
#include "core/tensor.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tessera {

/// Compressed rows: the neighbours of particle a are column[row[a]] ... column[row[a + 1] - 1], ascending, a
/// excluded. b is a neighbour of a exactly when a is one of b: |X_a - X_b| < max(support_a, support_b) and
/// the two see each other.
struct Neighbours {
  std::vector<std::int64_t> row;
  std::vector<std::int32_t> column;
  std::vector<double> support; ///< kernel radius of each particle, m

  std::int64_t size() const { return static_cast<std::int64_t>(support.size()); }
  std::int64_t edges() const { return static_cast<std::int64_t>(column.size()); }
  std::int64_t count(std::int64_t a) const { return row[a + 1] - row[a]; }
  double mean() const { return static_cast<double>(edges()) / static_cast<double>(size()); }
  /// Kernel radius of the pair: the larger of the two, so that W is the same seen from both ends.
  double pair_support(std::int64_t a, std::int64_t b) const {
    return support[a] > support[b] ? support[a] : support[b];
  }
};

/// All pairs within the supports that see each other (positions in m; z = 0 in plane strain).
Neighbours find_neighbours(std::span<const Vec3> X, std::vector<double> support,
                           const HiddenPairs& hidden = {});

/// Each particle's distance to the k-th nearest of the others it sees, m; infinite where it sees fewer.
std::vector<double> distance_to_nearest(std::span<const Vec3> X, int k, const HiddenPairs& hidden = {});

/// The same for the particles listed only, in their order.
std::vector<double> distance_to_nearest(std::span<const Vec3> X, int k, const HiddenPairs& hidden,
                                        std::span<const std::int32_t> of);

} // namespace tessera
