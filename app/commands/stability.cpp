#include "app/advection_report.hpp"
#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/run_folder.hpp"
#include "io/atomic_file.hpp"

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

} // namespace

void stability(const Options& options) {
  Console console(options);
  stability_of_the_model(options, console);
}

} // namespace tessera::app
