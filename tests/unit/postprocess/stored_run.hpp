/// A run folder as the program leaves it, with made-up numbers.
#pragma once

#include "io/cloud_file.hpp"
#include "io/field_series.hpp"
#include "io/history.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/postprocess/taylor_bar.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace tessera::test {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// `radius` is the last value of the probe radius_m; `extra` goes into summary.json as it is.
inline void store_run(const std::filesystem::path& folder, double radius, const std::string& extra = "") {
  std::filesystem::create_directories(folder);
  store(
      folder / "summary.json",
      fmt::format(R"({{"case": "bar", "title": "Taylor bar", "version": "0.1.0", "seed": 18446744073709551615,
 "particles": 4131, "spacing": 0.00064, "steps": 1331, "dt_min": 3.1e-9, "wall_seconds": 12.25,
 "us_per_particle_step": 1.5, "energy": {{"kinetic": 4.5, "balance_error": 0.0012}},
 "max": {{"equivalent_plastic_strain": 2.5, "von_mises": 6.5e8}}, "min": {{"jacobian": 0.75}},
 "extent_min": [-0.0069, -0.0069, 0], "extent_max": [0.0069, 0.0069, 0.0215],
 "probes": {{"radius_m": {}}}{}}})",
                  radius, extra));
  store(folder / "quality.json", R"({"particles": 4131, "volume_error": 1e-15, "sets": {"base": 81}})");
  io::HistoryFile history(folder / "history.csv");
  history.columns({"time_s", "step", "kinetic_J", "plastic_J", "external_J", "balance_error", "radius_m"});
  for (int i = 0; i <= 50; ++i)
    history.row({i * 1.6e-6, 10.0 * i, 200 * std::exp(-i / 12.0), 195 * (1 - std::exp(-i / 12.0)), 0,
                 1e-5 * i, 3.2e-3 + (radius - 3.2e-3) * (1 - std::exp(-i / 15.0))});
  io::FrameSeries frames(folder);
  for (int i = 0; i < 2; ++i) {
    const TaylorBar bar(i, 1.28e-3);
    frames.write(bar.at(8e-5 * i));
    if (i == 0)
      io::write_cloud(bar.cloud(1.28e-3), folder / "cloud.vtp");
  }
}

} // namespace tessera::test
