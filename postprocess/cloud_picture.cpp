#include "postprocess/cloud_picture.hpp"

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/neighbours.hpp"
#include "io/cloud_file.hpp"
#include "postprocess/picture.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// "lattice", "two-pass Voronoi cloud, seed 3".
std::string kind_of(const ParticleCloud& cloud) {
  const std::string name = cloud.arrangement == "voronoi"   ? "two-pass Voronoi"
                           : cloud.arrangement == "poisson" ? "Poisson"
                                                            : cloud.arrangement;
  return cloud.arrangement == "lattice" ? name : fmt::format("{}, seed {}", name, cloud.seed);
}

Chart chart_of(const std::string& title, const std::string& x_title, const std::vector<double>& values) {
  const Histogram classes = histogram(values);
  Curve bars;
  bars.bars = true;
  for (std::size_t k = 0; k < classes.counts.size(); ++k) {
    bars.x.push_back(static_cast<double>(k) * classes.width);
    bars.y.push_back(static_cast<double>(classes.counts[k]));
  }
  return {title, x_title, "Particles", false, false, {bars}};
}

} // namespace

CellsOnDisk::CellsOnDisk(const fs::path& folder, const ParticleCloud& cloud, const CellMesh* cells,
                         Progress& progress) {
  if (cloud.size() > most_cells_drawn)
    return;
  if (!cells || cells->cells.empty()) {
    if (fs::exists(folder / "cells.vtu"))
      file_ = fs::absolute(folder / "cells.vtu");
    return;
  }
  try {
    scratch_.emplace();
    io::write_cells(*cells, cloud, scratch_->path() / "cells.vtu");
    file_ = scratch_->path() / "cells.vtu";
  } catch (const RunError& error) {
    progress.note(fmt::format("no cells in the picture: {}", error.what()));
  }
}

Drawing cloud_drawing(const fs::path& folder, const ParticleCloud& cloud, const fs::path& cells) {
  constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
  const std::string file = fs::absolute(folder / "cloud.vtp").string();
  const std::string& polyhedra = cells.native();
  const std::string label =
      fmt::format("{} particles, spacing {}", cloud.size(), with_unit(cloud.spacing, "m"));
  const double pitch = cloud.arrangement == "lattice" ? cloud.spacing : 0; // others': found from the points
  Drawing drawing;
  drawing.file = fs::absolute(folder / "cloud.png").string();
  drawing.title = fmt::format("Particles by subvolume ({})", kind_of(cloud));
  drawing.field = "volume";
  drawing.view = "iso";
  drawing.outline = true;
  drawing.cloud = true;
  if (cloud.dimension == 2)
    drawing.panels = {{file, label, no_time, pitch, "", polyhedra}};
  else
    drawing.panels = {{file, label, no_time, pitch, "", ""},
                      {file, polyhedra.empty() ? "near half left out" : "Voronoi cells, near half left out",
                       no_time, pitch, "y", polyhedra}};
  if (fs::exists(folder / "body.vtu"))
    for (Panel& panel : drawing.panels)
      panel.body = fs::absolute(folder / "body.vtu").string();
  return drawing;
}

Histogram histogram(const std::vector<double>& values) {
  const double most = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  Histogram classes;
  // 1, 2 or 5 times a power of ten.
  const double least = most > 0 ? most / 50 : 1;
  classes.width = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {2.0, 2.5, 2.0})
    if (classes.width < least)
      classes.width *= factor;
  classes.counts.assign(static_cast<std::size_t>(most / classes.width + 0.5) + 1, 0);
  for (const double value : values)
    ++classes.counts[static_cast<std::size_t>(value / classes.width + 0.5)];
  return classes;
}

Evenness evenness(const ParticleCloud& cloud) {
  Evenness even;
  if (cloud.size() > 1)
    even.distance = distance_to_nearest(cloud.X, 1);
  for (double& distance : even.distance)
    distance /= cloud.spacing;
  even.volume = cloud.V;
  const double mean = mean_of(cloud.V);
  for (double& volume : even.volume)
    volume /= mean;
  return even;
}

Plot histogram_plot(const fs::path& folder, const ParticleCloud& cloud, const Evenness& even) {
  Plot plot;
  plot.file = fs::absolute(folder / "cloud_histograms.png").string();
  plot.beside = true;
  const bool plane = cloud.dimension == 2;
  plot.charts = {
      chart_of("Distance to the nearest particle",
               fmt::format("Distance / h,  h = {}", with_unit(cloud.spacing, "m")), even.distance),
      chart_of("Subvolume",
               fmt::format("Subvolume / mean,  mean = {}", with_unit(mean_of(cloud.V), plane ? "m²" : "m³")),
               even.volume)};
  return plot;
}

std::vector<Table> evenness_tables(const Evenness& even) {
  std::vector<Table> tables{
      {{"", "smallest", "1 %", "10 %", "median", "90 %", "99 %", "largest", "mean", "deviation"}, {}}};
  const std::pair<const char*, const std::vector<double>*> kinds[] = {
      {"Distance to the nearest / h", &even.distance}, {"Subvolume / mean", &even.volume}};
  for (const auto& [name, values] : kinds) {
    if (values->empty())
      continue;
    std::vector<double> sorted = *values;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::string> row{name};
    for (const double part : {0.0, 0.01, 0.1, 0.5, 0.9, 0.99, 1.0})
      row.push_back(fmt::format(
          "{:.3f}",
          sorted[static_cast<std::size_t>(std::lround(part * static_cast<double>(sorted.size() - 1)))]));
    const double mean = mean_of(sorted);
    double square = 0;
    for (const double value : sorted)
      square += (value - mean) * (value - mean);
    row.push_back(fmt::format("{:.3f}", mean));
    row.push_back(fmt::format("{:.3f}", std::sqrt(square / static_cast<double>(sorted.size()))));
    tables.front().rows.push_back(row);

    Table& shares = tables.emplace_back(Table{{name, "Particles", "Share"}, {}, 0});
    const Histogram classes = histogram(*values);
    for (std::size_t k = 0; k < classes.counts.size(); ++k)
      if (classes.counts[k] > 0)
        shares.rows.push_back(
            {fmt::format("{:.4g} to {:.4g}", std::max(0.0, (static_cast<double>(k) - 0.5) * classes.width),
                         (static_cast<double>(k) + 0.5) * classes.width),
             std::to_string(classes.counts[k]),
             fmt::format("{:.2f} %", 100.0 * static_cast<double>(classes.counts[k]) /
                                         static_cast<double>(values->size()))});
  }
  return tables;
}

std::vector<fs::path> draw_cloud(const fs::path& folder, Progress& progress, const CellMesh* cells) try {
  const ParticleCloud cloud = io::read_cloud(folder / "cloud.vtp");
  const CellsOnDisk polyhedra(folder, cloud, cells, progress);
  return render({{cloud_drawing(folder, cloud, polyhedra.file())}, {}}, progress);
} catch (const Error& error) {
  if (interrupted())
    throw;
  progress.note(fmt::format("no cloud.png: {}", error.what()));
  return {};
}

} // namespace tessera::post
