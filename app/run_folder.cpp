#include "app/run_folder.hpp"

#include "core/error.hpp"
#include "io/atomic_file.hpp"

#include <fmt/format.h>

#include <fstream>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* signature = "# Written by tessera";

bool is_ours(const fs::path& folder) {
  for (const char* name : {"summary.json", "quality.json", "cloud.vtp", "fields.pvd", "compare.json",
                           "hyperbolicity.json", "stability.json"})
    if (fs::exists(folder / name))
      return true;
  for (const char* name : {"case.toml", "study.toml"}) {
    std::ifstream stored(folder / name);
    if (std::string line; std::getline(stored, line) && line.starts_with(signature))
      return true;
  }
  return false;
}

} // namespace

fs::path default_folder(const Case& the_case) {
  return fs::path("runs") / the_case.name;
}

void open_folder(const fs::path& folder, bool of_study) {
  std::error_code failed;
  if (fs::is_directory(folder, failed) && !fs::is_empty(folder, failed) && !failed)
    require(is_ours(folder) && fs::exists(folder / "study.toml") == of_study,
            of_study ? "the output folder holds files that are not a study's"
                     : "the output folder holds files that are not a run's",
            folder.string(), "name an empty or new folder with -o");
  io::make_output_folder(folder);
}

RunFolder::RunFolder(fs::path folder) : path_(std::move(folder)), existed_(fs::exists(path_)) {
  open_folder(path_);
}

RunFolder::~RunFolder() {
  std::error_code failed;
  if (!existed_)
    fs::remove(path_, failed); // only where it is empty
}

void store_input(const fs::path& to, const fs::path& from, const std::vector<std::string>& overrides,
                 const std::string& text) {
  std::string header = fmt::format("{} {} from {}", signature, TESSERA_VERSION, from.string());
  for (const std::string& assignment : overrides)
    header += " --set " + assignment;
  for (char& c : header)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      c = ' ';
  io::write_text(to, header + "\n" + text);
}

void store_case(const Case& the_case, const std::vector<std::string>& overrides, const fs::path& folder) {
  store_input(folder / "case.toml", the_case.path, overrides, the_case.text);
}

void remove_solution(const fs::path& folder) {
  for (const char* name : {"summary.json", "history.csv", "fields.pvd", "report.md", "report.html"})
    fs::remove(folder / name);
  fs::remove_all(folder / "fields");
  std::vector<fs::path> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png" && entry.path().filename() != "cloud.png")
      pictures.push_back(entry.path());
  for (const fs::path& picture : pictures)
    fs::remove(picture);
}

void remove_all_results(const fs::path& folder) {
  remove_solution(folder);
  for (const char* name : {"cloud.vtp", "body.vtu", "cells.vtu", "quality.json", "cloud.png"})
    fs::remove(folder / name);
}

bool holds_cloud_of(const fs::path& folder, const Case& the_case) {
  const fs::path cloud = folder / "cloud.vtp", stored = folder / "case.toml";
  std::error_code failed;
  if (!fs::exists(cloud, failed) || !fs::exists(stored, failed))
    return false;
  const auto made = fs::last_write_time(cloud, failed);
  if (failed)
    return false;
  if (!the_case.geometry.shape) {
    const auto changed = fs::last_write_time(the_case.geometry.file, failed);
    if (!failed && changed > made)
      return false;
  }
  try {
    return read_case(stored, {}).cloud_text == the_case.cloud_text;
  } catch (const InputError&) { // stored by another version: its cloud may differ as well
    return false;
  }
}

} // namespace tessera::app
