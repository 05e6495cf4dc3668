/// Where a method holds: what became of each run, laid out over two axes of a study.
#pragma once

#include "app/study/results.hpp"
#include "core/progress.hpp"

#include <filesystem>
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

/// map.png; false where it could not be drawn, with a note that says why.
bool draw_map(const Study& study, const Results& results, const std::filesystem::path& folder,
              Progress& progress);

} // namespace tessera::app
