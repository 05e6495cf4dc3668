#include "postprocess/child_process.hpp"

#include "core/interrupt.hpp"

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace tessera::post {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> out;
  for (std::string& word : words)
    out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

std::vector<std::string> environment_with_tmpdir(const fs::path& scratch) {
  std::vector<std::string> out;
  for (char** entry = environ; *entry; ++entry)
    if (!std::string_view(*entry).starts_with("TMPDIR="))
      out.emplace_back(*entry);
  out.push_back("TMPDIR=" + scratch.string());
  return out;
}

pid_t start(std::vector<std::string> arguments, const fs::path& log, const fs::path& scratch) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::vector<std::string> environment = environment_with_tmpdir(scratch);
  pid_t child = -1;
  if (::posix_spawnp(&child, arguments[0].c_str(), &files, &attributes, pointers(arguments).data(),
                     pointers(environment).data()) != 0)
    child = -1;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return child;
}

/// Asks the group to end, so that xvfb-run stops its server, and insists a moment later.
void end_group(pid_t child) {
  ::kill(-child, SIGTERM);
  for (int i = 0; i < 20 && ::waitpid(child, nullptr, WNOHANG) == 0; ++i)
    std::this_thread::sleep_for(50ms);
  ::kill(-child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

} // namespace

ChildResult run_child(const std::vector<std::string>& arguments, double seconds, const fs::path& log,
                      const fs::path& scratch) {
  ChildResult result;
  const pid_t child = start(arguments, log, scratch);
  if (child < 0)
    return result;
  result.started = true;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    result.interrupted = interrupted();
    result.timed_out = !result.interrupted && std::chrono::steady_clock::now() > limit;
    if (result.interrupted || result.timed_out) {
      end_group(child);
      return result;
    }
    std::this_thread::sleep_for(5ms);
  }
  if (WIFEXITED(status))
    result.exit_status = WEXITSTATUS(status);
  return result;
}

fs::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / name;
    if (::access(program.c_str(), X_OK) == 0 && !fs::is_directory(program))
      return program;
  }
  return {};
}

} // namespace tessera::post
