#include "app/commands/commands.hpp"
#include "app/run_folder.hpp"
#include "app/stages.hpp"
#include "postprocess/picture.hpp"

#include <fmt/format.h>

namespace tessera::app {

void run(const Options& options) {
  Console console(options);
  const Case the_case = read_case(options.case_file, options.overrides);
  the_case.require_scene();
  require_cad_file(the_case);
  const RunFolder place(results_folder(the_case, options));
  const std::filesystem::path& folder = place.path();
  console.progress().note(fmt::format("{}: writing to {}", the_case.title, folder.string()));
  const preprocess::Prepared prepared = prepare_particles(the_case, options.cells, console);
  const double spent = spent_so_far();
  begin_results(the_case, options, prepared, folder, options.cells);
  if (options.pictures)
    post::draw_cloud(folder, console.progress(), &prepared.cells);
  const Solution solution = solve_particles(the_case, prepared.cloud, folder, spent, console);
  std::vector<std::filesystem::path> drawn;
  if (options.pictures)
    drawn = draw_results(the_case, folder, console);
  console.result(describe(the_case, solution.summary, folder, drawn), solution.json);
}

} // namespace tessera::app
