/// Whether processes a test has to do with are still there.
#pragma once

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace tessera::test {

/// A killed process takes a moment to be gone: ended, or ended and not yet collected by the system's first
/// process.
inline bool ends_within_two_seconds(int process) {
  for (int i = 0; i < 200; ++i) {
    std::ifstream in("/proc/" + std::to_string(process) + "/stat");
    const std::string status{std::istreambuf_iterator<char>(in), {}};
    if (status.empty() || status.find(") Z") != std::string::npos)
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

} // namespace tessera::test
