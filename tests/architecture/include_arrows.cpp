#include "tests/architecture/include_arrows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string_view>

namespace tessera::architecture {
namespace {

namespace fs = std::filesystem;

/// Folder -> the folders it may include from.
const std::map<std::string, std::set<std::string>> stages = {
    {"core", {"core"}},
    {"preprocess", {"core", "preprocess"}},
    {"solver", {"core", "solver"}},
    {"io", {"core", "io"}},
    {"postprocess", {"core", "preprocess", "solver", "io", "postprocess"}},
    {"app", {"core", "preprocess", "solver", "io", "postprocess", "app"}}};

const std::vector<std::string> solver_layers = {"operators", "physics", "boundary", "time", "scene"};

struct Library {
  const char* name;
  std::regex header;
  std::set<std::string> allowed;
};
const std::vector<Library> libraries = {
    {"VTK", std::regex("vtk[A-Za-z0-9_]*\\.h"), {"io", "postprocess"}},
    {"HDF5", std::regex("(hdf5|H5)[A-Za-z0-9_]*\\.h"), {"io", "postprocess"}},
    {"CGAL", std::regex("CGAL/.*"), {"preprocess"}},
    {"gmsh", std::regex("gmsh.*"), {"preprocess"}},
    {"Voro++", std::regex("voro\\+\\+.*"), {"preprocess"}},
    {"toml++", std::regex("toml\\+\\+.*"), {"app"}},
    {"CLI11", std::regex("CLI/.*"), {"app"}}};

std::optional<std::size_t> solver_layer(const std::string& path) {
  for (std::size_t i = 0; i < solver_layers.size(); ++i)
    if (path.starts_with("solver/" + solver_layers[i] + "/"))
      return i;
  return std::nullopt;
}

std::string first_folder(const std::string& path) {
  return path.substr(0, path.find('/'));
}

/// What is wrong with one include of `file` (both relative to the root), or nothing.
std::optional<std::string> fault(const std::string& file, const std::string& header, bool own) {
  const std::string from = first_folder(file);
  if (own) {
    const std::string to = first_folder(header);
    if (!stages.contains(to))
      return fmt::format("'{}' is not named by its path from the root", header);
    if (!stages.at(from).contains(to))
      return fmt::format("{} may not include {} ('{}')", from, to, header);
    const auto from_layer = solver_layer(file), to_layer = solver_layer(header);
    if (from_layer && to_layer && *to_layer > *from_layer)
      return fmt::format("solver/{} may not include solver/{} ('{}')", solver_layers[*from_layer],
                         solver_layers[*to_layer], header);
    return std::nullopt;
  }
  for (const Library& library : libraries)
    if (std::regex_match(header, library.header) && !library.allowed.contains(from))
      return fmt::format("{} may not see {} ('{}')", from, library.name, header);
  return std::nullopt;
}

} // namespace

std::vector<fs::path> source_files(const fs::path& root) {
  std::vector<fs::path> files;
  for (const auto& [stage, allowed] : stages) {
    if (!fs::is_directory(root / stage))
      continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / stage)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".hpp" || extension == ".cpp" || extension == ".h")
        files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> violations(const fs::path& root) {
  const std::regex include(R"(^\s*#\s*include\s*(["<])([^">]+)[">].*)");
  std::vector<std::string> found;
  for (const fs::path& path : source_files(root)) {
    const std::string file = fs::relative(path, root).generic_string();
    std::ifstream in(path);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      std::smatch match;
      if (!std::regex_match(line, match, include))
        continue;
      if (const auto what = fault(file, match[2], match[1] == "\""))
        found.push_back(fmt::format("{}:{}: {}", file, number, *what));
    }
  }
  return found;
}

} // namespace tessera::architecture
