/// report.md, report.html and the plots of one run, or of a cloud that was only prepared: what a person reads
/// first.
#pragma once

#include "core/cell_mesh.hpp"
#include "core/progress.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::post {

/// Energies and probes against time (energies.png, probes.png), how even the cloud is (cloud_histograms.png),
/// and the reports with the figures of summary.json and quality.json, every picture in the folder and the
/// case; report.html holds all it shows. `title` heads them where summary.json has none. Returns the files
/// written.
std::vector<std::filesystem::path> write_report(const std::filesystem::path& folder, Progress& progress,
                                                const std::string& title = "");

/// The same for a folder that holds a prepared cloud (cloud.vtp, quality.json), with cloud.png as
/// draw_cloud() draws it: all pictures in one child process.
std::vector<std::filesystem::path> write_cloud_report(const std::filesystem::path& folder, Progress& progress,
                                                      const std::string& title = "",
                                                      const CellMesh* cells = nullptr);

} // namespace tessera::post
