#include "app/commands/commands.hpp"
#include "app/run_folder.hpp"
#include "app/stages.hpp"
#include "io/cloud_file.hpp"
#include "postprocess/picture.hpp"

#include <fmt/format.h>

namespace tessera::app {

void solve(const Options& options) {
  Console console(options);
  const Case the_case = read_case(options.case_file, options.overrides);
  the_case.require_scene();
  const std::filesystem::path folder = results_folder(the_case, options);

  // Everything that can be wrong with the input is found before the folder is touched.
  const bool named = !options.cloud.empty();
  const bool stored = !named && holds_cloud_of(folder, the_case);
  std::optional<ParticleCloud> cloud;
  if (named || stored)
    cloud = io::read_cloud(named ? options.cloud : folder / "cloud.vtp");
  else
    require_cad_file(the_case);
  if (cloud)
    require_places(the_case, *cloud);
  const RunFolder place(folder);
  console.progress().note(fmt::format("{}: writing to {}", the_case.title, folder.string()));

  double spent = spent_so_far();
  if (cloud) {
    console.progress().note(
        fmt::format("particles from {}", (named ? options.cloud : folder / "cloud.vtp").string()));
    remove_solution(folder);
    store_case(the_case, options.overrides, folder);
    if (named) {
      io::write_cloud(*cloud, folder / "cloud.vtp");
      std::filesystem::remove(folder / "body.vtu"); // of another body, for all that is known
    }
  } else {
    preprocess::Prepared prepared = prepare_particles(the_case, false, console);
    spent = spent_so_far();
    begin_results(the_case, options, prepared, folder, false);
    post::draw_cloud(folder, console.progress(), &prepared.cells);
    cloud = std::move(prepared.cloud);
  }
  const Solution solution = solve_particles(the_case, *cloud, folder, spent, console);
  console.result(describe(the_case, solution.summary, folder, {}), solution.json);
}

} // namespace tessera::app
