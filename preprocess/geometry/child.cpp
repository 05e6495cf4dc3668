#include "preprocess/geometry/child.hpp"

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

namespace tessera::preprocess {
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
[[noreturn]] void become(char* const* arguments, const char* folder,
                         [[maybe_unused]] const ChildLimits& limits, int output, int failure, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent)
    ::_exit(127);
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  limit(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__ // its shadow memory alone reserves terabytes
  limit(RLIMIT_AS, limits.bytes);
#endif
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing >= 0 && ::dup2(nothing, 0) == 0 && ::dup2(output, 1) == 1 && ::dup2(output, 2) == 2 &&
      ::chdir(folder) == 0)
    ::execv(arguments[0], arguments);
  const int why = errno;
  [[maybe_unused]] const auto written = ::write(failure, &why, sizeof why);
  ::_exit(127);
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

  std::vector<char*> arguments;
  for (const std::string& word : command)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0)
    return {ChildEnd::How::not_started, errno, {}, 0};
  if (pid == 0)
    become(arguments.data(), folder.c_str(), limits, output_end.get(), failure_end.get(), parent);
  ::setpgid(pid, pid); // both sides set it, so that neither can be first by luck
  output_end.close();
  failure_end.close();

  ChildEnd end{ChildEnd::How::exited, 0, {}, 0};
  if (int why = 0; ::read(failure.get(), &why, sizeof why) == sizeof why) {
    ::waitpid(pid, nullptr, 0);
    return {ChildEnd::How::not_started, why, {}, 0};
  }

  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(limits.seconds);
  bool killed = false, open = true;
  int status = 0;
  rusage usage{};
  for (;;) {
    if (!killed && (interrupted() || Clock::now() >= deadline)) {
      end.how = interrupted() ? ChildEnd::How::interrupted : ChildEnd::How::out_of_time;
      ::kill(-pid, SIGKILL);
      killed = true;
    }
    const pid_t ended = ::wait4(pid, &status, WNOHANG, &usage);
    if (open)
      open = drain(output.get(), end.output);
    if (ended == pid || (ended < 0 && errno != EINTR))
      break;
    pollfd waiting{output.get(), POLLIN, 0};
    ::poll(&waiting, open ? 1 : 0, 20);
  }
  ::kill(-pid, SIGKILL); // what the program itself may have started and left behind
  if (end.output.size() > kept_output)
    end.output.erase(0, end.output.size() - kept_output);
  end.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  if (!killed) {
    end.how = WIFSIGNALED(status) ? ChildEnd::How::signalled : ChildEnd::How::exited;
    end.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  return end;
}

} // namespace tessera::preprocess
