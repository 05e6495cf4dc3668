/// The numbers a finished run left in summary.json (and quality.json), with the words and units a reader
/// needs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera::post {

/// One number or word of a run.
struct Figure {
  std::string key;             ///< of the JSON file: "max.von_mises", "probes.radius_m"
  std::string label;           ///< "Largest von Mises stress"
  std::string unit;            ///< SI; empty for pure numbers and words
  std::string text;            ///< as stored; for numbers with all digits
  std::optional<double> value; ///< absent for words
};

/// Figures of folder/summary.json in the order of a report. InputError saying what to run where there is
/// none, or when it is damaged.
std::vector<Figure> summary_figures(const std::filesystem::path& folder);

/// Figures of folder/quality.json, and of its two volumes how far they are apart; none where the file is not
/// there. InputError when it is damaged.
std::vector<Figure> quality_figures(const std::filesystem::path& folder);

/// The figure of that key; nullptr where there is none.
const Figure* find_figure(const std::vector<Figure>& figures, const std::string& key);

/// The value times `factor` with at most five significant digits; whole numbers and words in full.
std::string shown(const Figure& figure, double factor);

} // namespace tessera::post
