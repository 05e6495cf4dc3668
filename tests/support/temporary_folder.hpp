/// A folder of the test's own, gone afterwards; and a way to fill the disk without being root.
#pragma once

#include "core/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {

struct TemporaryFolder : tessera::TemporaryFolder {
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }
};

inline std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void store(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Runs `work` in a child process that may write no file above `bytes` and returns the message of the
/// exception it threw, "" when it threw none.
inline std::string message_with_file_limit(rlim_t bytes, const std::function<void()>& work) {
  int channel[2];
  if (::pipe(channel) != 0)
    return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN); // so that write() fails instead
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::string message;
    try {
      work();
    } catch (const std::exception& error) {
      message = error.what();
    }
    const bool told = ::write(channel[1], message.data(), message.size()) >= 0;
    ::_exit(told ? 0 : 1);
  }
  ::close(channel[1]);
  std::string message;
  char buffer[512];
  for (ssize_t count; (count = ::read(channel[0], buffer, sizeof buffer)) > 0;)
    message.append(buffer, static_cast<std::size_t>(count));
  ::close(channel[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? message : "the child crashed";
}

} // namespace tessera::test
