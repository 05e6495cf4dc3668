#include "app/commands/commands.hpp"
#include "app/stages.hpp"
#include "core/error.hpp"
#include "io/field_series.hpp"

#include <fmt/format.h>

namespace tessera::app {

void post(const Options& options) {
  Console console(options);
  const std::filesystem::path folder = options.folders.front();
  require(std::filesystem::exists(folder / "case.toml"), "no run is stored here", folder.string(),
          "name the folder a run wrote to, for example runs/taylor_bar");
  io::read_series(folder); // frames must be there: without them there is nothing to draw
  const Case the_case = read_case(folder / "case.toml", options.overrides);
  const auto drawn = draw_results(the_case, folder, console);

  std::string text = fmt::format("{}: {} files in {}\n", the_case.title, drawn.size(), folder.string());
  std::string json;
  for (const auto& file : drawn) {
    text += "  " + file.filename().string() + "\n";
    json += fmt::format("{}\n  \"{}\"", json.empty() ? "" : ",", file.filename().string());
  }
  console.result(text, fmt::format("[{}\n]\n", json));
}

} // namespace tessera::app
