/// How a cloud of particles is presented before any run: cloud.png and cloud_histograms.png as jobs for the
/// renderer, and tables.
#pragma once

#include "core/cell_mesh.hpp"
#include "core/particle_cloud.hpp"
#include "core/temporary_folder.hpp"
#include "postprocess/document.hpp"
#include "postprocess/render_job.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera::post {

/// Where the renderer finds a cloud's cells while this lives: given ones in a temporary file, stored ones in
/// folder/cells.vtu, none where there are neither, the cloud is too large to show them or, with a note, the
/// disk refuses.
class CellsOnDisk {
 public:
  CellsOnDisk(const std::filesystem::path& folder, const ParticleCloud& cloud, const CellMesh* cells,
              Progress& progress);
  const std::filesystem::path& file() const { return file_; } ///< empty for none

 private:
  std::optional<TemporaryFolder> scratch_;
  std::filesystem::path file_;
};

/// cloud.png of folder/cloud.vtp, which holds `cloud`, with the cells of that file where it is not empty.
Drawing cloud_drawing(const std::filesystem::path& folder, const ParticleCloud& cloud,
                      const std::filesystem::path& cells);

/// Numbers sorted into classes about the multiples of `width`: values within half a width of k width are
/// counted in counts[k].
struct Histogram {
  double width = 0;
  std::vector<std::int64_t> counts;
};

/// At most fifty classes of a round width from zero to the largest value; all values finite and not negative.
Histogram histogram(const std::vector<double>& values);

/// What tells how even a cloud is, one number a particle.
struct Evenness {
  std::vector<double> distance; ///< to the nearest other particle, over ParticleCloud::spacing; empty for one
  std::vector<double> volume;   ///< over the mean
};
Evenness evenness(const ParticleCloud& cloud);

/// cloud_histograms.png in `folder`.
Plot histogram_plot(const std::filesystem::path& folder, const ParticleCloud& cloud,
                    const Evenness& evenness);

/// Smallest, some quantiles and largest of both in one table, then the histogram of each.
std::vector<Table> evenness_tables(const Evenness& evenness);

} // namespace tessera::post
