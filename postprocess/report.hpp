/// report.md and the history plots of one run: what a person reads first.
#pragma once

#include "core/progress.hpp"

#include <filesystem>
#include <vector>

namespace tessera::post {

/// Energies and probes against time (energies.png, probes.png) and report.md with the figures of summary.json
/// and quality.json and every picture in the folder. Returns the files written.
std::vector<std::filesystem::path> write_report(const std::filesystem::path& folder, Progress& progress);

} // namespace tessera::post
