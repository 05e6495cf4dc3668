/// Where a method holds: what became of each run, laid out over two axes of a study.
#pragma once

#include "app/study/results.hpp"
#include "postprocess/render_job.hpp"

#include <string>

namespace tessera::app {

enum class Verdict {
  none,       ///< not run, or without an error
  stable,     ///< and as accurate as asked
  inaccurate, ///< came to its end, too far off
  unstable    ///< broke off, or its energy came out of nothing
};

Verdict verdict(const Row& row, const MapLayout& layout);

/// "stable"; nothing for none.
std::string verdict_word(Verdict verdict);

/// The verdicts and errors of all runs over the map's rows and columns, other axes as panels.
post::CellChart map_of(const Study& study, const Results& results);

} // namespace tessera::app
