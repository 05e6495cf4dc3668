#include "app/stages.hpp"

#include "app/run_folder.hpp"
#include "app/summary.hpp"
#include "core/cost.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "io/atomic_file.hpp"
#include "io/body_file.hpp"
#include "io/cloud_file.hpp"
#include "io/field_series.hpp"
#include "io/history.hpp"
#include "postprocess/picture.hpp"
#include "postprocess/report.hpp"
#include "preprocess/geometry/rigid_surface.hpp"
#include "solver/scene/probe_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

/// As a shell would want it.
std::string shell_word(const fs::path& path) {
  const std::string word = path.string();
  return word.find_first_of(" \t'\"\\$&;()*?[]<>|#~`!{}") == std::string::npos ? word
                                                                               : fmt::format("'{}'", word);
}

} // namespace

void require_cad_file(const Case& the_case) {
  const auto require_file = [&](const preprocess::GeometrySource& source, const std::string& key) {
    std::error_code failed;
    require(source.shape || fs::is_regular_file(source.file, failed),
            fmt::format("there is no CAD file {}", source.file.string()), the_case.where(key),
            "paths are relative to the case file");
  };
  require_file(the_case.geometry, "geometry.file");
  for (const WallSurface& surface : the_case.wall_surfaces)
    require_file(surface.source, fmt::format("wall.{}.surface.file", surface.entry));
}

solver::SceneSpec scene_with_surfaces(const Case& the_case, Console& console) {
  solver::SceneSpec scene = the_case.scene;
  if (const auto resting = solver::resting_constants(scene); !resting.empty())
    console.progress().note(fmt::format(
        "solver.{} of the case {} no part: the dissipation is \"{}\"", fmt::join(resting, ", solver."),
        resting.size() > 1 ? "play" : "plays", solver::chosen_dissipation(scene)));
  for (const WallSurface& surface : the_case.wall_surfaces) {
    const preprocess::Domain domain = preprocess::import_geometry(surface.source, console.progress());
    stop_if_interrupted("import");
    scene.walls[surface.wall].shape = std::make_shared<const preprocess::RigidSurface>(
        domain, the_case.where(fmt::format("wall.{}.surface", surface.entry)));
  }
  return scene;
}

void require_places(const Case& the_case, const ParticleCloud& cloud) {
  const auto require_set = [&](const std::string& name, const std::string& key) {
    if (name != "all")
      cloud.set(name, the_case.where(key));
  };
  const solver::SceneSpec& scene = the_case.scene;
  for (std::size_t i = 0; i < scene.initial.size(); ++i)
    require_set(scene.initial[i].on, fmt::format("initial.{}.on", i));
  for (std::size_t i = 0; i < scene.boundary.size(); ++i)
    require_set(scene.boundary[i].on, fmt::format("boundary.{}.on", i));
  for (std::size_t i = 0; i < scene.probes.size(); ++i)
    if (scene.probes[i].at)
      solver::ProbeReader(scene.probes[i], cloud); // refuses points outside
    else
      require_set(scene.probes[i].on, fmt::format("output.probe.{}.on", i));
}

fs::path results_folder(const Case& the_case, const Options& options) {
  return options.output.empty() ? default_folder(the_case) : options.output;
}

preprocess::Prepared prepare_particles(const Case& the_case, bool cells, Console& console) {
  const preprocess::Domain domain = preprocess::import_geometry(the_case.geometry, console.progress());
  stop_if_interrupted("import");
  preprocess::ParticleRequest request = the_case.particles;
  const double expected = request.count > 0 ? static_cast<double>(request.count)
                                            : domain.volume / std::pow(request.spacing, domain.dimension);
  request.keep_cells = cells || expected < static_cast<double>(post::most_cells_drawn);
  preprocess::Prepared prepared = preprocess::prepare(domain, request, console.progress());
  require_places(the_case, prepared.cloud);
  stop_if_interrupted("preparation");
  return prepared;
}

void begin_results(const Case& the_case, const Options& options, const preprocess::Prepared& prepared,
                   const fs::path& folder, bool cells) {
  remove_all_results(folder);
  store_case(the_case, options.overrides, folder);
  io::write_cloud(prepared.cloud, folder / "cloud.vtp");
  io::write_body(prepared.body, folder / "body.vtu");
  if (cells)
    io::write_cells(prepared.cells, prepared.cloud, folder / "cells.vtu");
  io::write_text(folder / "quality.json", preprocess::to_json(prepared.quality));
}

double spent_so_far() {
  return cpu_seconds() + cpu_seconds_of_children();
}

Solution solve_particles(const Case& the_case, const ParticleCloud& cloud, const fs::path& folder,
                         double spent_seconds, Console& console) {
  require_places(the_case, cloud);
  const solver::SceneSpec scene = scene_with_surfaces(the_case, console);
  io::FrameSeries series(folder);
  io::HistoryFile history(folder / "history.csv");
  int frames = 0;
  double last = 0;
  const solver::Outputs outputs{[&](const Frame& frame) {
                                  series.write(frame);
                                  ++frames;
                                  last = frame.time;
                                },
                                [&](const std::vector<std::string>& columns) { history.columns(columns); },
                                [&](const std::vector<double>& row) { history.row(row); }};
  Solution solution;
  try {
    solution.summary = solver::run(scene, cloud, outputs, console.progress());
  } catch (const RunError& e) {
    if (frames == 0)
      throw;
    throw RunError(
        e.what(),
        fmt::format("{} frames up to {:.4g} s and history.csv are kept in {}", frames, last, folder.string()),
        fmt::format("draw them with: tessera post {}; solve anew with: tessera solve {} -o {}",
                    shell_word(folder), shell_word(folder / "case.toml"), shell_word(folder)));
  }
  solution.summary.setup_seconds += spent_seconds;
  solution.json = summary_json(the_case, cloud, solution.summary);
  io::write_text(folder / "summary.json", solution.json);
  return solution;
}

std::vector<fs::path> draw_results(const Case& the_case, const fs::path& folder, Console& console) {
  constexpr double far_away = 100; // m, of lines that go on for ever: beyond every picture
  std::vector<fs::path> files;
  if (!the_case.pictures.empty())
    files = post::draw(the_case.pictures, {folder}, {the_case.title}, folder, console.progress(),
                       post::tools_of(the_case.scene.walls, far_away));
  for (const fs::path& file : post::write_report(folder, console.progress()))
    files.push_back(file);
  return files;
}

std::string describe(const Case& the_case, const solver::Summary& s, const fs::path& folder,
                     const std::vector<fs::path>& drawn) {
  std::string text = fmt::format(
      "{}: {} particles, {} steps to {:.4g} s in {} ({:.2f} us per particle and step)\n", the_case.title,
      s.particles, s.steps, s.time, duration(s.wall_seconds), s.us_per_particle_step);
  const auto line = [&](const std::string& what, double value, const char* unit) {
    text += fmt::format("  {:<28}{:.6g}{}{}\n", what, value, *unit == '\0' ? "" : " ", unit);
  };
  for (const auto& [name, value] : s.probes)
    line(name, value, "");
  if (the_case.scene.material.plasticity)
    line("largest plastic strain", s.extremes.equivalent_plastic_strain, "");
  line("largest von Mises stress", s.extremes.von_mises, "Pa");
  line("smallest J", s.extremes.jacobian, "");
  line("energy balance error", s.energy.balance_error, "");
  text += fmt::format("results in {}: summary.json, history.csv, fields.pvd (ParaView)", folder.string());
  for (const fs::path& file : drawn)
    text += ", " + file.filename().string();
  return text + "\n";
}

} // namespace tessera::app
