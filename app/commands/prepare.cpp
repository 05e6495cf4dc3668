#include "app/commands/commands.hpp"
#include "app/run_folder.hpp"
#include "app/stages.hpp"
#include "postprocess/report.hpp"

#include <fmt/format.h>

namespace tessera::app {

void prepare(const Options& options) {
  Console console(options);
  const Case the_case = read_case(options.case_file, options.overrides);
  require_cad_file(the_case);
  const RunFolder place(results_folder(the_case, options));
  const std::filesystem::path& folder = place.path();
  console.progress().note(fmt::format("{}: writing to {}", the_case.title, folder.string()));
  const preprocess::Prepared prepared = prepare_particles(the_case, options.cells, console);
  begin_results(the_case, options, prepared, folder, options.cells);
  const auto drawn = post::write_cloud_report(folder, console.progress(), the_case.title, &prepared.cells);
  const preprocess::Quality& q = prepared.quality;

  std::string text = fmt::format("{}: {} particles, subvolumes sum to {:.9g} m^{} (relative error {:.1e})\n"
                                 "  nearest neighbours {:.4g} m at least, {:.4g} m on average\n",
                                 the_case.title, q.particles, q.volume_sum, q.dimension, q.volume_error,
                                 q.spacing_min, q.spacing_mean);
  for (const auto& [name, count] : q.sets)
    text += fmt::format("  set {}: {} particles\n", name, count);
  text += fmt::format("particles in {}: cloud.vtp, quality.json{}", folder.string(),
                      options.cells ? ", cells.vtu" : "");
  for (const auto& file : drawn)
    text += ", " + file.filename().string();
  text += "\n";
  console.result(text, preprocess::to_json(q));
}

} // namespace tessera::app
