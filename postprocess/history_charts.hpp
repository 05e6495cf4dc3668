/// From columns of history.csv to charts.
#pragma once

#include "io/history.hpp"
#include "postprocess/render_job.hpp"

#include <string>
#include <vector>

namespace tessera::post {

/// One run's history under the name its curve carries.
struct NamedHistory {
  std::string name;
  const io::History* history;
};

/// The columns of a case's probes, in their order: all but those every history has and those of forces.
std::vector<std::string> probe_columns(const io::History& history);

/// The columns of walls and supports that are more than noise beside the others of theirs.
std::vector<std::string> force_columns(const io::History& history);

/// `column` of each history against time, one curve a run, in readable units.
Chart chart_over_time(const std::string& title, const std::string& column,
                      const std::vector<NamedHistory>& runs);

/// The energies of one run that are not zero throughout, and the balance error below them. `per`: what the
/// amounts are by, as "per metre of thickness" of plane bodies; may be empty.
std::vector<Chart> energy_charts(const std::string& title, const io::History& history,
                                 const std::string& per = "");

/// The components of the body's linear and of its angular momentum.
std::vector<Chart> momentum_charts(const std::string& title, const io::History& history,
                                   const std::string& per = "");

/// One chart of the forces of each wall and each support on the body, and one of a wall's largest pressure.
std::vector<Chart> force_charts(const io::History& history, const std::string& per = "");

} // namespace tessera::post
