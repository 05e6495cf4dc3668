/// Chapter 4's accuracy and stability analysis for people, programs and docs.
#pragma once

#include "postprocess/render_job.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::app {

/// A wave at a step: scheme, wave number, eigenvalue, amplification, errors; a line each.
std::string advection_csv();

/// Tables 4.1 to 4.4: a line a particle of the stencil.
std::string kernel_tables_csv();

/// Tables 4.1 to 4.4 and the limits of stability.
std::string advection_json();

/// The largest stable courant numbers, aligned for a terminal.
std::string courant_table();

/// The whole for reading: tables, limits, and what the pictures (by their file names) show.
std::string advection_report(const std::vector<std::filesystem::path>& pictures);

/// Eigenvalues in Heun's region (figures 4.2 to 4.5), amplification factors in the unit circle (4.6, 4.7),
/// dissipation and dispersion errors (4.8 to 4.11), into `folder`.
std::vector<post::Plot> advection_plots(const std::filesystem::path& folder);

} // namespace tessera::app
