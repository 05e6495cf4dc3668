#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "io/atomic_file.hpp"
#include "postprocess/child_process.hpp"
#include "postprocess/render_job.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

constexpr double time_limit = 300; ///< s, for all pictures of one job

class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "tessera-render-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw RunError("cannot make a temporary folder", name, "check the space in it");
    folder_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

/// The renderer is installed beside the program, or where TESSERA_LIBEXEC says.
fs::path renderer() {
  if (const char* folder = std::getenv("TESSERA_LIBEXEC"))
    return fs::path(folder) / "tessera-render";
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path() / "tessera-render";
}

/// Lines of `file` that begin with `prefix`, without it.
std::vector<std::string> lines_after(const std::string& prefix, const fs::path& file) {
  std::vector<std::string> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(prefix))
      found.push_back(line.substr(prefix.size()));
  return found;
}

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos)
      last = line;
  return last.substr(0, 300);
}

std::string why_it_failed(const ChildResult& result, const fs::path& log) {
  if (!result.started)
    return "xvfb-run could not be started";
  if (result.timed_out)
    return fmt::format("the renderer was stopped after {:.0f} s", time_limit);
  const std::string last = last_line(log);
  return last.empty() ? fmt::format("the renderer ended with status {}", result.exit_status) : last;
}

} // namespace

std::vector<fs::path> render(const RenderJob& job, Progress& progress) try {
  if (job.drawings.empty() && job.plots.empty())
    return {};
  const fs::path xvfb = find_program("xvfb-run");
  const fs::path program = renderer();
  if (xvfb.empty()) {
    progress.note("no pictures: xvfb-run is not installed (on Debian: apt install xvfb xauth)");
    return {};
  }
  if (!fs::exists(program)) {
    progress.note(
        fmt::format("no pictures: there is no {} (set TESSERA_LIBEXEC to its folder)", program.string()));
    return {};
  }
  const Scratch scratch;
  const fs::path file = scratch.folder() / "job.json", log = scratch.folder() / "log";
  io::write_text(file, to_json(job));
  const ChildResult result =
      run_child({xvfb.string(), "-a", "-s", "-screen 0 1600x1200x24", program.string(), file.string()},
                time_limit, log, scratch.folder());
  if (result.interrupted)
    stop_if_interrupted("drawing");
  std::vector<fs::path> written;
  for (const std::string& name : lines_after("file: ", log))
    written.emplace_back(name);
  const std::vector<std::string> notes = lines_after("note: ", log);
  for (const std::string& note : notes)
    progress.note(note);
  if (written.size() + notes.size() < job.drawings.size() + job.plots.size())
    progress.note(fmt::format("pictures are missing: {}", why_it_failed(result, log)));
  return written;
} catch (const std::exception& error) {
  // A picture never fails a run: only an interruption goes on to the caller.
  if (interrupted())
    throw;
  progress.note(fmt::format("no pictures: {}", error.what()));
  return {};
}

} // namespace tessera::post
