/// Runs beside each other: the same numbers in one table, the same fields on one colour scale.
#pragma once

#include "core/progress.hpp"
#include "postprocess/picture.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::post {

struct Comparison {
  std::vector<std::string> runs;                ///< folder names, made distinct
  std::vector<std::string> rows;                ///< "radius (m)", "particles", "wall seconds", ...
  std::vector<std::vector<std::string>> values; ///< one list a row, one entry a run; "-" where a run has none
  std::vector<std::filesystem::path> files;     ///< what was written
};

/// Reads summary.json and history.csv of each folder; writes compare.csv, compare.json, compare.md, one PNG
/// overlaying every probe that all histories share, and side-by-side pictures of PlasticStrain and VonMises,
/// into `output`. InputError when a folder holds no finished run.
Comparison compare(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& output,
                   Progress& progress);

/// The table as aligned text for a terminal.
std::string table(const Comparison& comparison);

} // namespace tessera::post
