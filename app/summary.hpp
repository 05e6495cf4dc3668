/// summary.json and what `check` foretells, as JSON.
#pragma once

#include "app/case/case.hpp"

#include <optional>
#include <string>

namespace tessera::app {

/// SI units, flat names; numbers that are not finite become null.
std::string summary_json(const Case& the_case, const ParticleCloud& cloud, const solver::Summary& summary);

/// What is known of a case before it runs.
struct Outlook {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero(); ///< bounding box of the body, m
  preprocess::Quality quality;
  double spacing = 0; ///< m
  std::vector<std::string> sets;
  std::optional<solver::Forecast> forecast; ///< none for a case of particles alone
};
std::string outlook_json(const Case& the_case, const Outlook& outlook);
std::string outlook_text(const Case& the_case, const Outlook& outlook);

} // namespace tessera::app
