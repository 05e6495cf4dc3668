#include "app/study/run_store.hpp"

#include "core/child_process.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/temporary_folder.hpp"
#include "io/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <sstream>
#include <thread>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

constexpr double grace = 10; ///< s between asking a run to end and insisting

/// The line "error: ..." of the program's output, or the last there is.
std::string complaint(const std::string& output) {
  std::istringstream in(output);
  std::string found;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("error: "))
      return line.substr(7);
    else if (!line.empty())
      found = line;
  return found;
}

/// What became of a run that left no summary.
std::string why_it_ended(const ChildEnd& end, double time_limit) {
  switch (end.how) {
  case ChildEnd::How::not_started:
    return fmt::format("could not be started: {}", std::strerror(end.code));
  case ChildEnd::How::out_of_time:
    return fmt::format("stopped after {:g} s, the study's time_limit", time_limit);
  case ChildEnd::How::signalled:
    return fmt::format("ended by signal {} ({})", end.code, strsignal(end.code));
  default:
    return complaint(end.output).empty() ? fmt::format("ended with status {}", end.code)
                                         : complaint(end.output);
  }
}

class Queue {
 public:
  Queue(std::vector<RunToDo> runs, const RunStore& store, double time_limit, Progress& progress)
      : runs_(std::move(runs)), store_(store), time_limit_(time_limit), progress_(progress) {
    std::stable_sort(runs_.begin(), runs_.end(),
                     [](const RunToDo& a, const RunToDo& b) { return a.work > b.work; });
    double total = 0;
    for (const RunToDo& run : runs_)
      total += run.work;
    progress_.begin("study", total);
  }

  /// Takes runs until there are none.
  void work() {
    while (const RunToDo* run = next()) {
      // What an interrupted run left would spare this one its set-up, which is measured.
      fs::remove_all(store_.run(run->id));
      const ChildEnd end =
          run_child({program_.string(), "run", store_.case_file(run->id).string(), "-o",
                     store_.run(run->id).string(), "--no-pictures", "--quiet", "--threads", "1"},
                    scratch_.path(), {time_limit_ > 0 ? time_limit_ : 1e9, 0, grace});
      ended(*run, end);
    }
  }

  const std::map<std::string, std::string>& passing_failures() const { return passing_; }
  void finish() { progress_.finish(said()); }

 private:
  const RunToDo* next() {
    const std::lock_guard lock(mutex_);
    return interrupted() || next_ == runs_.size() ? nullptr : &runs_[next_++];
  }

  void ended(const RunToDo& run, const ChildEnd& end) {
    const std::lock_guard lock(mutex_);
    if (!store_.finished(run.id)) {
      if (end.how == ChildEnd::How::interrupted || interrupted()) {
        fs::remove_all(store_.run(run.id));
        return;
      }
      const std::string why = why_it_ended(end, time_limit_);
      progress_.note(fmt::format("{}: {}", run.words, why));
      if (end.how == ChildEnd::How::exited && end.code == static_cast<int>(ExitStatus::run_failed) &&
          !why.starts_with("interrupted"))
        store_.keep_failure(run.id, why);
      else
        passing_[run.id] = why;
      ++failed_;
    }
    ++ended_;
    done_ += run.work;
    progress_.advance(done_, said());
  }

  std::string said() const {
    return fmt::format("{} of {} runs{}", ended_, runs_.size(),
                       failed_ > 0 ? fmt::format(", {} failed", failed_) : "");
  }

  std::vector<RunToDo> runs_;
  const RunStore& store_;
  double time_limit_;
  Progress& progress_;
  const fs::path program_ = fs::read_symlink("/proc/self/exe");
  const TemporaryFolder scratch_;
  std::mutex mutex_; ///< guards what follows, the store's failures and the progress
  std::size_t next_ = 0, ended_ = 0, failed_ = 0;
  double done_ = 0;
  std::map<std::string, std::string> passing_;
};

} // namespace

std::optional<std::string> RunStore::failure(const std::string& id) const {
  std::ifstream in(failure_file(id));
  if (!in)
    return std::nullopt;
  std::string why{std::istreambuf_iterator<char>(in), {}};
  while (why.ends_with('\n'))
    why.pop_back();
  return why;
}

void RunStore::keep_failure(const std::string& id, const std::string& why) const {
  io::write_text(failure_file(id), why + "\n");
}

void RunStore::forget_failure(const std::string& id) const {
  fs::remove(failure_file(id));
}

std::map<std::string, std::string> run_all(std::vector<RunToDo> runs, const RunStore& store, int at_once,
                                           double time_limit, Progress& progress) {
  if (runs.empty())
    return {};
  const auto workers = std::min(static_cast<std::size_t>(at_once), runs.size());
  Queue queue(std::move(runs), store, time_limit, progress);
  std::vector<std::exception_ptr> thrown(workers);
  {
    // Each waits for its children by itself: a child ends with the thread that started it.
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < workers; ++i)
      threads.emplace_back([&queue, &failure = thrown[i]] {
        try {
          queue.work();
        } catch (...) {
          failure = std::current_exception();
        }
      });
  }
  for (const std::exception_ptr& failure : thrown)
    if (failure)
      std::rethrow_exception(failure);
  if (!interrupted())
    queue.finish();
  return queue.passing_failures();
}

} // namespace tessera::app
