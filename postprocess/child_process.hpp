/// Another program, run with a time limit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::post {

struct ChildResult {
  bool started = false;
  bool timed_out = false;
  bool interrupted = false;
  int exit_status = -1; ///< -1 where a signal ended it
};

/// Runs `arguments` (the first is the program, looked up in PATH) in a process group of its own with
/// everything it prints going to `log` and TMPDIR set to `scratch`. Past `seconds`, or when this program is
/// interrupted, the whole group is ended.
ChildResult run_child(const std::vector<std::string>& arguments, double seconds,
                      const std::filesystem::path& log, const std::filesystem::path& scratch);

/// The program of that name in PATH; empty where there is none.
std::filesystem::path find_program(const std::string& name);

} // namespace tessera::post
