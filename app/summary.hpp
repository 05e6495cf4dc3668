/// summary.json.
#pragma once

#include "app/case/case.hpp"

#include <string>

namespace tessera::app {

/// SI units, flat names; numbers that are not finite become null.
std::string summary_json(const Case& the_case, const ParticleCloud& cloud, const solver::Summary& summary);

} // namespace tessera::app
