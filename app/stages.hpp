/// The three stages of a case with their files: prepare, solve, draw.
#pragma once

#include "app/case/case.hpp"
#include "app/console.hpp"
#include "app/options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::app {

/// InputError naming the key of the case when a CAD file, its body's or a wall's, is not there.
void require_cad_file(const Case& the_case);

/// The case's scene with the surfaces of its walls imported.
solver::SceneSpec scene_with_surfaces(const Case& the_case, Console& console);

/// InputError when a set the case speaks of is not one of the cloud's (naming the key), or a probe's point
/// lies outside of it.
void require_places(const Case& the_case, const ParticleCloud& cloud);

/// Where the case's results go, for begin_results() once there are any.
std::filesystem::path results_folder(const Case& the_case, const Options& options);

/// Imports and fills the body. Writes nothing: what a refused case would have replaced is still there. With
/// the cells where they are asked for, and where they are not too many to be drawn.
preprocess::Prepared prepare_particles(const Case& the_case, bool cells, Console& console);

/// Empties the folder of earlier results and stores the case and its particles in it: cloud.vtp, body.vtu,
/// quality.json and, where `cells`, cells.vtu.
void begin_results(const Case& the_case, const Options& options, const preprocess::Prepared& prepared,
                   const std::filesystem::path& folder, bool cells);

/// Runs the solver: history.csv, fields.pvd, fields/, summary.json. Returns the text of summary.json.
/// A run that fails or is interrupted leaves its frames and history, no summary, and a RunError that says so.
/// `spent_seconds`: processor time its particles took, for the summary's setup_seconds.
struct Solution {
  solver::Summary summary;
  std::string json;
};
Solution solve_particles(const Case& the_case, const ParticleCloud& cloud,
                         const std::filesystem::path& folder, double spent_seconds, Console& console);

/// Processor time of the program so far with that of the importer's processes.
double spent_so_far();

/// The case's pictures, the plots and report.md from what the folder holds. Returns the files written.
std::vector<std::filesystem::path> draw_results(const Case& the_case, const std::filesystem::path& folder,
                                                Console& console);

/// A finished run for a person to read.
std::string describe(const Case& the_case, const solver::Summary& summary,
                     const std::filesystem::path& folder, const std::vector<std::filesystem::path>& drawn);

} // namespace tessera::app
