#include "app/commands/commands.hpp"
#include "app/run_folder.hpp"
#include "app/stages.hpp"

#include <fmt/format.h>

namespace tessera::app {

void run(const Options& options) {
  Console console(options);
  const Case the_case = read_case(options.case_file, options.overrides);
  the_case.require_scene();
  require_cad_file(the_case);
  const std::filesystem::path folder = options.output.empty() ? default_folder(the_case) : options.output;
  open_folder(folder);
  console.progress().note(fmt::format("{}: writing to {}", the_case.title, folder.string()));

  remove_all_results(folder);
  store_case(the_case, options.overrides, folder);
  const preprocess::Prepared prepared = prepare_particles(the_case, folder, options.cells, console);
  const Solution solution = solve_particles(the_case, prepared.cloud, folder, console);
  const auto drawn = draw_results(the_case, folder, console);
  console.result(describe(the_case, solution.summary, folder, drawn), solution.json);
}

} // namespace tessera::app
