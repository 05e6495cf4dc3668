#include "core/child_process.hpp"

#include "core/interrupt.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <string_view>

namespace tessera {
namespace {

constexpr std::size_t kept_output = 64 * 1024;

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (fd_ >= 0)
      ::close(fd_);
    fd_ = -1;
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

void limit(int resource, std::uint64_t value) {
  const rlimit both{value, value};
  ::setrlimit(resource, &both);
}

/// After fork in a program that may have threads: nothing here may allocate. Never returns.
[[noreturn]] void become(char* const* arguments, char* const* environment, const char* folder,
                         [[maybe_unused]] const ChildLimits& limits, int output, int failure, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent)
    ::_exit(127);
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  limit(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__ // its shadow memory alone reserves terabytes
  if (limits.bytes > 0)
    limit(RLIMIT_AS, limits.bytes);
#endif
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing >= 0 && ::dup2(nothing, 0) == 0 && ::dup2(output, 1) == 1 && ::dup2(output, 2) == 2 &&
      ::chdir(folder) == 0)
    ::execve(arguments[0], arguments, environment);
  const int why = errno;
  [[maybe_unused]] const auto written = ::write(failure, &why, sizeof why);
  ::_exit(127);
}

std::vector<std::string> environment_with_tmpdir(const std::filesystem::path& folder) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (!std::string_view(*entry).starts_with("TMPDIR="))
      entries.emplace_back(*entry);
  entries.push_back("TMPDIR=" + std::filesystem::absolute(folder).string());
  return entries;
}

/// What exec wants: pointers to the words and a null at the end. Valid as long as the words are.
std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> list;
  for (const std::string& word : words)
    list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  return list;
}

/// Appends what is waiting in the pipe; false at its end.
bool drain(int fd, std::string& output) {
  char buffer[4096];
  for (;;) {
    const ssize_t n = ::read(fd, buffer, sizeof buffer);
    if (n == 0)
      return false;
    if (n < 0)
      return errno == EAGAIN || errno == EINTR;
    output.append(buffer, static_cast<std::size_t>(n));
    if (output.size() > 2 * kept_output)
      output.erase(0, output.size() - kept_output);
  }
}

} // namespace

ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& folder,
                   const ChildLimits& limits) {
  int output_pipe[2], failure_pipe[2];
  if (::pipe2(output_pipe, O_CLOEXEC) != 0)
    return {ChildEnd::How::not_started, errno, {}, 0};
  Descriptor output(output_pipe[0]), output_end(output_pipe[1]);
  if (::pipe2(failure_pipe, O_CLOEXEC) != 0)
    return {ChildEnd::How::not_started, errno, {}, 0};
  Descriptor failure(failure_pipe[0]), failure_end(failure_pipe[1]);
  ::fcntl(output.get(), F_SETFL, O_NONBLOCK);

  const std::vector<std::string> environment = environment_with_tmpdir(folder);
  const std::vector<char*> arguments = pointers(command), variables = pointers(environment);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0)
    return {ChildEnd::How::not_started, errno, {}, 0};
  if (pid == 0)
    become(arguments.data(), variables.data(), folder.c_str(), limits, output_end.get(), failure_end.get(),
           parent);
  ::setpgid(pid, pid); // both sides set it, so that neither can be first by luck
  output_end.close();
  failure_end.close();

  ChildEnd end{ChildEnd::How::exited, 0, {}, 0};
  if (int why = 0; ::read(failure.get(), &why, sizeof why) == sizeof why) {
    ::waitpid(pid, nullptr, 0);
    return {ChildEnd::How::not_started, why, {}, 0};
  }

  using Clock = std::chrono::steady_clock;
  const auto after = [](double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  };
  auto deadline = after(limits.seconds);
  bool asked = false, open = true;
  int status = 0;
  rusage usage{};
  for (;;) {
    if (!asked && (interrupted() || Clock::now() >= deadline)) {
      end.how = interrupted() ? ChildEnd::How::interrupted : ChildEnd::How::out_of_time;
      ::kill(-pid, limits.grace > 0 ? SIGTERM : SIGKILL);
      deadline = after(limits.grace);
      asked = true;
    }
    if (asked && Clock::now() >= deadline)
      ::kill(-pid, SIGKILL);
    const pid_t ended = ::wait4(pid, &status, WNOHANG, &usage);
    if (open)
      open = drain(output.get(), end.output);
    if (ended == pid || (ended < 0 && errno != EINTR))
      break;
    pollfd waiting{output.get(), POLLIN, 0};
    ::poll(&waiting, open ? 1 : 0, 20);
  }
  // What the program itself may have started and left behind: time to tidy up, then no more.
  for (const auto last = asked ? deadline : after(limits.grace); Clock::now() < last && ::kill(-pid, 0) == 0;)
    ::usleep(5000);
  ::kill(-pid, SIGKILL);
  if (end.output.size() > kept_output)
    end.output.erase(0, end.output.size() - kept_output);
  end.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  if (!asked) {
    end.how = WIFSIGNALED(status) ? ChildEnd::How::signalled : ChildEnd::How::exited;
    end.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  return end;
}

std::filesystem::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder) / name;
    if (::access(program.c_str(), X_OK) == 0 && !std::filesystem::is_directory(program))
      return program;
  }
  return {};
}

std::filesystem::path companion_program(const std::string& name) {
  if (const char* folder = std::getenv("TESSERA_LIBEXEC"); folder != nullptr && *folder != '\0')
    return std::filesystem::absolute(std::filesystem::path(folder) / name);
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error && std::filesystem::exists(self.parent_path() / name, error))
    return self.parent_path() / name;
  return std::filesystem::path(TESSERA_PROGRAM_FOLDER) / name;
}

} // namespace tessera
