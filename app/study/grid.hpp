/// From the axes of a study to its runs.
#pragma once

#include "app/study/study_file.hpp"

#include <string>
#include <vector>

namespace tessera::app {

struct GridPoint {
  std::vector<std::string> labels;      ///< one an axis
  std::vector<std::string> assignments; ///< of all axes, in their order
};

/// Every combination of one value an axis, the last axis running fastest, without those left out. InputError
/// where they are more than 10 000 or none is left.
std::vector<GridPoint> expand_grid(const Study& study);

} // namespace tessera::app
