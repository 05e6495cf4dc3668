#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "postprocess/point_data.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>

namespace tessera::app {

void export_fields(const Options& options) {
  Console console(options);
  const std::filesystem::path folder = options.folders.front();
  const post::Snapshot snapshot = post::read_snapshot(folder, options.time);
  const std::filesystem::path output =
      options.output.empty() ? folder / fmt::format("{}.csv", snapshot.file.stem().string()) : options.output;
  io::write_text(output, post::point_data_csv(snapshot));
  const auto particles = snapshot.cloud.size();
  console.result(fmt::format("{}: {} particles at {}\n", output.string(), particles,
                             post::with_unit(snapshot.frame.time, "s")),
                 fmt::format("{{\"particles\": {}, \"time\": {}}}\n", particles, snapshot.frame.time));
}

} // namespace tessera::app
