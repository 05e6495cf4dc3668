#include "postprocess/compare.hpp"

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/run_folder.hpp"
#include "core/error.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace tessera::app {

void compare(const Options& options) {
  Console console(options);
  require(options.folders.size() >= 2, "compare needs at least two runs", "", "see tessera compare --help");
  for (const auto& folder : options.folders)
    require(std::filesystem::exists(folder / "summary.json"), "no finished run is stored here",
            folder.string(), "name the folders runs wrote to, for example runs/taylor_bar");
  const std::filesystem::path output =
      options.output.empty() ? std::filesystem::path("runs") / "compare" : options.output;
  post::Sight sight;
  sight.fields = options.fields;
  sight.time = options.time;
  sight.times = options.times;
  sight.view = options.view;
  sight.clip = options.clip == "none" ? "" : options.clip;
  sight.skin = options.style == "skin";
  sight.outline = options.outline;
  sight.magnify = options.magnify;
  sight.columns = options.columns;
  if (options.reference)
    sight.configuration = post::Configuration::reference;
  for (const std::string& section : options.sections)
    sight.sections.push_back(post::section_from(section));
  const RunFolder folder(output); // gone again where the runs turn out not to hold what is asked for
  const post::Comparison comparison = post::compare(options.folders, output, console.progress(), sight);

  std::string text = post::table(comparison) + fmt::format("\nin {}:", output.string());
  for (const auto& file : comparison.files)
    text += fmt::format(" {}", file.filename().string());
  std::ifstream stored(output / "compare.json");
  const std::string json{std::istreambuf_iterator<char>(stored), {}};
  console.result(text, json);
}

} // namespace tessera::app
