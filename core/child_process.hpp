/// A program started, watched and, where need be, ended: with limits on time and memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

struct ChildLimits {
  double seconds;          ///< wall time
  std::uint64_t bytes = 0; ///< address space; 0: no limit
  double grace = 0;        ///< seconds between asking it to end (SIGTERM) and insisting (SIGKILL)
};

struct ChildEnd {
  enum class How { exited, signalled, out_of_time, interrupted, not_started };
  How how;
  int code;                 ///< exit status, signal number, or errno of the failed start
  std::string output;       ///< its standard output and error together, the last 64 KiB
  std::uint64_t peak_bytes; ///< largest resident set
};

/// Runs `command` (a path and its arguments; no shell) in `folder`, which is its TMPDIR too, in a process
/// group of its own that dies with this process, without core dumps, and waits. The whole group is ended at
/// the time limit and on Ctrl-C.
ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& folder,
                   const ChildLimits& limits);

/// The program of that name in PATH; empty where there is none.
std::filesystem::path find_program(const std::string& name);

/// A program of our own: in $TESSERA_LIBEXEC, else beside the running program, else where it was installed.
/// Not checked to be there.
std::filesystem::path companion_program(const std::string& name);

} // namespace tessera
