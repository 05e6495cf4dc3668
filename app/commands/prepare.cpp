#include "app/commands/commands.hpp"
#include "app/run_folder.hpp"
#include "app/stages.hpp"

#include <fmt/format.h>

namespace tessera::app {

void prepare(const Options& options) {
  Console console(options);
  const Case the_case = read_case(options.case_file, options.overrides);
  require_cad_file(the_case);
  const std::filesystem::path folder = options.output.empty() ? default_folder(the_case) : options.output;
  open_folder(folder);
  console.progress().note(fmt::format("{}: writing to {}", the_case.title, folder.string()));

  remove_all_results(folder);
  store_case(the_case, options.overrides, folder);
  const preprocess::Quality q = prepare_particles(the_case, folder, options.cells, console).quality;

  std::string text =
      fmt::format("{}: {} particles, subvolumes sum to {:.9g} m^3 (relative error {:.1e})\n"
                  "  nearest neighbours {:.4g} m at least, {:.4g} m on average\n",
                  the_case.title, q.particles, q.volume_sum, q.volume_error, q.spacing_min, q.spacing_mean);
  for (const auto& [name, count] : q.sets)
    text += fmt::format("  set {}: {} particles\n", name, count);
  text += fmt::format("particles in {}: cloud.vtp, quality.json{}\n", folder.string(),
                      options.cells ? ", cells.vtu" : "");
  console.result(text, preprocess::to_json(q));
}

} // namespace tessera::app
