/// What a study will run: every case read and checked before the first of them begins.
#pragma once

#include "app/study/study_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tessera::app {

struct PlannedRun {
  std::vector<std::string> labels; ///< one an axis; none of the finer run
  std::string words;               ///< the labels in a line
  std::string id;   ///< of its content: the case as it will run, the files it reads, the version
  std::string text; ///< the case as TOML
  double work = 0;  ///< estimated, in a unit of no meaning
};

struct Plan {
  std::vector<PlannedRun> runs;
  std::optional<PlannedRun> finer;
  std::string column; ///< of history.csv, of the probe that is measured
};

/// `overrides`: of the command line, for all runs. InputError, naming the run, for any case that is refused
/// or cannot be measured as the study says.
Plan plan_study(const Study& study, const std::vector<std::string>& overrides);

} // namespace tessera::app
