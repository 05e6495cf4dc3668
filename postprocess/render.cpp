#include "core/child_process.hpp"
#include "core/interrupt.hpp"
#include "core/temporary_folder.hpp"
#include "io/atomic_file.hpp"
#include "postprocess/render_job.hpp"

#include <fmt/format.h>

#include <atomic>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

/// A display of our own. Left to itself xvfb-run takes the first that looks free; a server that is just
/// ending then removes the new one's socket, and the renderer aborts.
int display_number() {
  static std::atomic<int> job = 0;
  return 1000 + (8 * static_cast<int>(::getpid()) + job++ % 8) % 50000;
}

/// Lines of `output` that begin with `prefix`, without it.
std::vector<std::string> lines_after(const std::string& prefix, const std::string& output) {
  std::vector<std::string> found;
  std::istringstream in(output);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(prefix))
      found.push_back(line.substr(prefix.size()));
  return found;
}

std::string last_line(const std::string& output) {
  std::istringstream in(output);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos)
      last = line;
  return last.substr(0, 300);
}

std::string why_it_failed(const ChildEnd& end, double seconds) {
  if (end.how == ChildEnd::How::not_started)
    return "xvfb-run could not be started";
  if (end.how == ChildEnd::How::out_of_time)
    return fmt::format("the renderer was stopped after {:.0f} s", seconds);
  const std::string last = last_line(end.output);
  return last.empty() ? fmt::format("the renderer ended with status {}", end.code) : last;
}

} // namespace

double time_limit(const RenderJob& job) {
  double seconds = 300;
  for (const Drawing& drawing : job.drawings)
    seconds += 5 * static_cast<double>(drawing.panels.size());
  return seconds;
}

std::vector<fs::path> render(const RenderJob& job, Progress& progress) try {
  const std::size_t wanted = job.drawings.size() + job.plots.size() + job.cell_charts.size();
  if (wanted == 0)
    return {};
  const fs::path xvfb = find_program("xvfb-run");
  const fs::path program = companion_program("tessera-render");
  if (xvfb.empty()) {
    progress.note("no pictures: xvfb-run is not installed (on Debian: apt install xvfb xauth)");
    return {};
  }
  if (!fs::exists(program)) {
    progress.note(
        fmt::format("no pictures: there is no {} (set TESSERA_LIBEXEC to its folder)", program.string()));
    return {};
  }
  const TemporaryFolder scratch;
  const fs::path file = scratch.path() / "job.json";
  io::write_text(file, to_json(job));
  // Without -noreset the server starts anew whenever a picture's window, its only client, is closed, and the
  // next window may find nobody. Asked to end before it is killed, so that xvfb-run stops its server.
  const ChildEnd end = run_child({xvfb.string(), "-n", std::to_string(display_number()), "-a", "-s",
                                  "-screen 0 1600x1200x24 -noreset", program.string(), file.string()},
                                 scratch.path(), {time_limit(job), 0, 1.0});
  if (end.how == ChildEnd::How::interrupted)
    stop_if_interrupted("drawing");
  std::vector<fs::path> written;
  for (const std::string& name : lines_after("file: ", end.output))
    written.emplace_back(name);
  const std::vector<std::string> notes = lines_after("note: ", end.output);
  for (const std::string& note : notes)
    progress.note(note);
  if (written.size() + notes.size() < wanted)
    progress.note(fmt::format("pictures are missing: {}", why_it_failed(end, time_limit(job))));
  return written;
} catch (const std::exception& error) {
  // A picture never fails a run: only an interruption goes on to the caller.
  if (interrupted())
    throw;
  progress.note(fmt::format("no pictures: {}", error.what()));
  return {};
}

} // namespace tessera::post
