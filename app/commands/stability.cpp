#include "app/advection_report.hpp"
#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/run_folder.hpp"
#include "app/stability_report.hpp"
#include "app/stages.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/cloud_file.hpp"

#include <fmt/format.h>

namespace tessera::app {
namespace {

std::string written(const std::filesystem::path& folder, std::vector<std::string> files,
                    const std::vector<std::filesystem::path>& drawn) {
  for (const auto& file : drawn)
    files.push_back(file.filename().string());
  std::string text = fmt::format("in {}:", folder.string());
  for (std::size_t i = 0; i < files.size(); ++i)
    text += (i == 0 ? " " : ", ") + files[i];
  return text + "\n";
}

void stability_of_the_model(const Options& options, Console& console) {
  const std::filesystem::path folder =
      options.output.empty() ? std::filesystem::path("runs") / "stability" : options.output;
  open_folder(folder);
  const std::string json = advection_json();
  io::write_text(folder / "stability.json", json);
  io::write_text(folder / "waves.csv", advection_csv());
  io::write_text(folder / "kernels.csv", kernel_tables_csv());
  const auto drawn = post::render({{}, advection_plots(folder)}, console.progress());
  io::write_text(folder / "report.md", advection_report(drawn));
  console.result(courant_table() +
                     written(folder, {"stability.json", "waves.csv", "kernels.csv", "report.md"}, drawn),
                 json);
}

Vec3 stretch_of(const Options& options) {
  if (options.stretch.empty())
    return Vec3::Ones();
  const Vec3 stretch(options.stretch[0], options.stretch[1], options.stretch[2]);
  constexpr double least = 0.05, most = 20;
  for (const double one : stretch)
    require(one >= least && one <= most, fmt::format("a stretch of {:g}", one), "--stretch",
            fmt::format("stretches lie between {:g} and {:g}, 1 for none", least, most));
  return stretch;
}

/// The particles a run of the case would have: those of its folder where it holds them.
ParticleCloud particles_of(const Case& the_case, const std::filesystem::path& folder, Console& console) {
  if (holds_cloud_of(folder, the_case)) {
    console.progress().note(fmt::format("particles from {}", (folder / "cloud.vtp").string()));
    ParticleCloud cloud = io::read_cloud(folder / "cloud.vtp");
    require_places(the_case, cloud);
    return cloud;
  }
  require_cad_file(the_case);
  return prepare_particles(the_case, false, console).cloud;
}

void stability_of_a_case(const Options& options, Console& console) {
  const Case the_case = read_case(options.case_file, options.overrides);
  the_case.require_scene();
  const Vec3 stretch = stretch_of(options);
  const RunFolder place(results_folder(the_case, options));
  const std::filesystem::path& folder = place.path();
  const ParticleCloud cloud = particles_of(the_case, folder, console);
  require(cloud.dimension == 3 || stretch[2] == 1, "a body in the plane does not stretch across it",
          "--stretch", "its third stretch is 1");
  const solver::StabilityFindings findings = solver::stability(the_case.scene, cloud, stretch);

  const std::string json = stability_json(the_case, stretch, findings);
  io::write_text(folder / "stability.json", json);
  std::vector<std::string> files{"stability.json"};
  std::vector<std::filesystem::path> drawn;
  for (const char* name : {"eigenvalues.csv", "eigenvalues.png"})
    std::filesystem::remove(folder / name); // of an earlier look
  if (findings.spectrum) {
    io::write_text(folder / "eigenvalues.csv", eigenvalues_csv(*findings.spectrum));
    files.push_back("eigenvalues.csv");
    drawn = post::render({{}, {eigenvalue_plot(findings, *findings.spectrum, folder / "eigenvalues.png")}},
                         console.progress());
  }
  console.result(stability_text(the_case, stretch, findings) + written(folder, files, drawn), json);
}

} // namespace

void stability(const Options& options) {
  Console console(options);
  if (!options.case_file.empty()) {
    stability_of_a_case(options, console);
    return;
  }
  require(options.stretch.empty(), "nothing to stretch", "--stretch", "name a case");
  require(options.overrides.empty(), "no case to override keys of", "--set", "name a case");
  stability_of_the_model(options, console);
}

} // namespace tessera::app
