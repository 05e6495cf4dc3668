/// What `check` tells of a case before it runs.
#pragma once

#include "app/case/case.hpp"
#include "app/rehearsal.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "solver/scene/forecast.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tessera::app {

struct Outlook {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero(); ///< bounding box of the body, m
  preprocess::Quality quality;
  double spacing = 0; ///< m
  std::vector<std::string> sets;
  std::optional<solver::Forecast> forecast; ///< none for a case of particles alone
  Rehearsal rehearsal;
  double setup_seconds = 0; ///< processor time of import, particles and operators
};

/// What the run is expected to take.
struct Expectation {
  std::int64_t steps = 0;
  double step_cpu_seconds = 0; ///< processor time of a step, all threads
  double cpu_seconds = 0;      ///< of the steps
  double seconds = 0;          ///< by the clock: set-up, steps, history and frames; without pictures
};
Expectation expected(const Case& the_case, const Outlook& outlook);

std::string outlook_json(const Case& the_case, const Outlook& outlook, bool explained);
/// `explained`: with what was chosen for the case, why, and the numbers behind it.
std::string outlook_text(const Case& the_case, const Outlook& outlook, bool explained);

} // namespace tessera::app
