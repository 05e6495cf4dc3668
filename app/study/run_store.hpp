/// The runs of a study: where each is kept under the name of its content, and the running of those that are
/// missing.
#pragma once

#include "core/progress.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tessera::app {

/// cases/ID.toml is what was run, runs/ID what it left, cases/ID.failed why it left nothing.
class RunStore {
 public:
  explicit RunStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path run(const std::string& id) const { return folder_ / "runs" / id; }
  std::filesystem::path case_file(const std::string& id) const { return folder_ / "cases" / (id + ".toml"); }

  /// summary.json is written last, and whole.
  bool finished(const std::string& id) const { return std::filesystem::exists(run(id) / "summary.json"); }
  /// Why it failed; nothing when it did not, or was never run.
  std::optional<std::string> failure(const std::string& id) const;
  bool missing(const std::string& id) const { return !finished(id) && !failure(id); }

  void keep_failure(const std::string& id, const std::string& why) const;
  void forget_failure(const std::string& id) const;

 private:
  std::filesystem::path failure_file(const std::string& id) const {
    return folder_ / "cases" / (id + ".failed");
  }
  std::filesystem::path folder_;
};

/// A run still to be done; its case file is stored.
struct RunToDo {
  std::string id;
  std::string words; ///< for messages: "lattice, thesis, 500"
  double work;       ///< estimated, in any unit
};

/// Runs them as processes of this program, `at_once` side by side and on one thread each, the most work
/// first. A run that fails, dies or takes longer than `time_limit` (wall time, s; 0: none) is noted and the
/// others go on; it is kept as a failure only where the solver gave up (status 1), the rest is tried again
/// next time. Returns early when interrupted: unfinished runs are then gone. By id, why those failed that are
/// not kept.
std::map<std::string, std::string> run_all(std::vector<RunToDo> runs, const RunStore& store, int at_once,
                                           double time_limit, Progress& progress);

} // namespace tessera::app
