/// history.csv: what a run's energies, momenta and probes did in time.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace tessera::io {

/// history.csv: a header of column names, then rows; flushed row by row.
class HistoryFile {
 public:
  explicit HistoryFile(const std::filesystem::path& file);
  void columns(const std::vector<std::string>& names);
  void row(const std::vector<double>& values);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

/// A stored history: names, and one column of numbers each.
struct History {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  /// InputError naming the columns there are when `name` is not one of them.
  const std::vector<double>& column(const std::string& name) const;
};
/// Lines before the names that begin with '#' are comments.
History read_history(const std::filesystem::path& file);

} // namespace tessera::io
