/// Pictures of stored fields, drawn off screen by a program of their own (tessera-render, beside the main
/// program).
#pragma once

#include "core/cell_mesh.hpp"
#include "core/progress.hpp"
#include "postprocess/tool.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera::post {

/// One picture: the body on white at one moment, at several side by side, or moving; with a colour bar with
/// unit, title and times.
struct Picture {
  std::string name = "picture";  ///< file name without .png
  std::string field;             ///< point array: PlasticStrain, VonMises, Pressure, volume, ...
  std::string view = "front";    ///< front (from -y), back, left, right, top (from +z), bottom, iso
  std::string clip;              ///< "", "x", "y" or "z": only what is beyond a plane across it is drawn
  std::optional<double> clip_at; ///< where, m; absent: in the body's middle
  std::optional<double> minimum, maximum; ///< colour range; absent: over the frames shown
  std::string frame = "last";             ///< last, first, or a time in seconds
  std::vector<double> times;              ///< in place of it: of frames side by side, s
  int frames = 0;                         ///< in place of it: so many, evenly from first to last
  bool animation = false;                 ///< frames one after the other; all there are unless chosen
  bool skin = false;                      ///< as one smooth piece in place of particles
  bool outline = false;                   ///< the undeformed body as lines
  bool tools = true;                      ///< the rigid tools about the body
  double magnify = 1;                     ///< times as large displacements are drawn
};

/// Renders each picture of each series folder in one child process under xvfb-run. Several `folders`: drawn
/// side by side on one colour scale with `labels` under them; with several moments a row each, one of these a
/// column. `tools` are about the bodies. Returns the files
/// written (in `output`). Where xvfb-run or the renderer is missing or fails, notes why on `progress` and
/// returns no files: a picture never fails a run.
std::vector<std::filesystem::path> draw(const std::vector<Picture>& pictures,
                                        const std::vector<std::filesystem::path>& folders,
                                        const std::vector<std::string>& labels,
                                        const std::filesystem::path& output, Progress& progress,
                                        const std::vector<Tool>& tools = {});

/// Up to how many particles a cloud's picture shows the Voronoi cells: those of larger ones could not be told
/// apart, and take long to draw.
inline constexpr std::int64_t most_cells_drawn = 50'000;

/// cloud.png: the particles of folder/cloud.vtp coloured by subvolume over the mean, beside them the far half
/// of the body as Voronoi cells; a plane body's cells face on. The cells are `cells` where given (they are
/// not stored), else those of folder/cells.vtu; without either, and above most_cells_drawn, the cut body
/// shows its particles. Fails as draw() does: with a note.
std::vector<std::filesystem::path> draw_cloud(const std::filesystem::path& folder, Progress& progress,
                                              const CellMesh* cells = nullptr);

} // namespace tessera::post
