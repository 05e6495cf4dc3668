/// How far the fields of runs are from those of the first.
#pragma once

#include "postprocess/snapshot.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tessera::post {

struct FieldDifference {
  std::string field;
  /// Root of the sum of |f - f_1|^2 V over that of |f_1|^2 V; absent where the first run's field is zero.
  std::optional<double> relative;
  double largest = 0; ///< of |f - f_1|, SI
};

/// Of one run from the first.
struct Difference {
  std::size_t points = 0; ///< that lie inside both bodies
  std::vector<FieldDifference> fields;
};

/// Every run's differences from the first (whose own are zero), both sampled by the corrected kernel at the
/// first one's particles, in the reference configuration: at most some 4000 of them, spread over the body.
/// Vectors differ as vectors. InputError where a run lacks a field.
std::vector<Difference> differences_from_first(const std::vector<Snapshot>& runs,
                                               const std::vector<std::string>& fields);

} // namespace tessera::post
