/// Runs beside each other: the same numbers in one table, the same fields on one colour scale.
#pragma once

#include "core/progress.hpp"
#include "postprocess/section.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::post {

/// What of the fields is looked at, and how.
struct Sight {
  std::vector<std::string> fields; ///< none: PlasticStrain where a run flows, and VonMises
  std::string time = "last", view = "front", clip = "y"; ///< as in Picture
  std::vector<double> times; ///< of pictures with a row a run and a column a time, s; none: at `time` only
  bool skin = false, outline = false; ///< as in Picture
  double magnify = 1;                 ///< as in Picture
  std::vector<std::string> columns;   ///< of history.csv, to be drawn over each other
  std::vector<Section> sections;
  Configuration configuration = Configuration::current; ///< of the sections
};

struct Comparison {
  std::vector<std::string> runs;                ///< folder names, made distinct
  std::vector<std::string> rows;                ///< "radius (m)", "particles", "wall seconds", ...
  std::vector<std::vector<std::string>> values; ///< one list a row, one entry a run; "-" where a run has none
  std::vector<std::filesystem::path> files;     ///< what was written
};

/// Reads summary.json, history.csv and a frame of each folder; writes compare.csv, compare.json, compare.md,
/// compare.html, PNGs overlaying every probe, every force and the named
/// columns that all histories share, side-by-side pictures of the
/// fields, and a chart and a .csv of each section, into `output`. The table ends with each run's differences
/// from the first (field_difference.hpp). InputError when a folder holds no finished run, or not what is
/// asked for.
Comparison compare(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& output,
                   Progress& progress, const Sight& sight = {});

/// The table as aligned text for a terminal.
std::string table(const Comparison& comparison);

} // namespace tessera::post
