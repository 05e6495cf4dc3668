/// Pictures of stored fields, drawn off screen by a program of their own (tessera-render, beside the main
/// program).
#pragma once

#include "core/progress.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera::post {

/// One picture: particles as shaded spheres on white, a colour bar with unit, title and time.
struct Picture {
  std::string name = "picture"; ///< file name without .png
  std::string field;            ///< point array: PlasticStrain, VonMises, Pressure, volume, ...
  std::string view = "front";   ///< front (from -y), back, left, right, top (from +z), bottom, iso
  std::string clip; ///< "", "x", "y" or "z": only the far half beside the body's middle plane is drawn
  std::optional<double> minimum, maximum; ///< colour range; absent: over the frames shown
  std::string frame = "last";             ///< last, first, or a time in seconds
  bool outline = false;                   ///< box of the reference configuration
};

/// Renders each picture of each series folder in one child process under xvfb-run. Several `folders`: drawn
/// side by side on one colour scale with `labels` under them. Returns the files written (in `output`). Where
/// xvfb-run or the renderer is missing or fails, notes why on `progress` and returns no files: a picture
/// never fails a run.
std::vector<std::filesystem::path> draw(const std::vector<Picture>& pictures,
                                        const std::vector<std::filesystem::path>& folders,
                                        const std::vector<std::string>& labels,
                                        const std::filesystem::path& output, Progress& progress);

/// cloud.png: the particles of folder/cloud.vtp coloured by subvolume, the near half left out beside the
/// whole.
std::vector<std::filesystem::path> draw_cloud(const std::filesystem::path& folder, Progress& progress);

} // namespace tessera::post
