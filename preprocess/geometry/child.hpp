/// A program started, watched and, where need be, ended: with limits on time and memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera::preprocess {

struct ChildLimits {
  double seconds;      ///< wall time
  std::uint64_t bytes; ///< address space
};

struct ChildEnd {
  enum class How { exited, signalled, out_of_time, interrupted, not_started };
  How how;
  int code;                 ///< exit status, signal number, or errno of the failed start
  std::string output;       ///< its standard output and error together, the last 64 KiB
  std::uint64_t peak_bytes; ///< largest resident set
};

/// Runs `command` (a path and its arguments; no shell) in `folder`, in a process group of its own that dies
/// with this process, without core dumps, and waits. The whole group is killed at the time limit and on
/// Ctrl-C.
ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& folder,
                   const ChildLimits& limits);

} // namespace tessera::preprocess
