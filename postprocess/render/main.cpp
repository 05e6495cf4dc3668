// tessera-render JOB.json: draws the pictures of one job off screen. Needs an X server (xvfb-run gives it
// one).
//
// Prints "file: PATH" for each picture written and "note: WHY" for each that was not; the main program reads
// both.

#include "core/error.hpp"
#include "io/vtk_messages.hpp"
#include "postprocess/render/cell_chart.hpp"
#include "postprocess/render/drawing.hpp"
#include "postprocess/render/plot.hpp"
#include "postprocess/render_job.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>

#include <unistd.h>

namespace {

using namespace tessera;

std::string content(const char* file) {
  std::ifstream in(file, std::ios::binary);
  require(in.good(), "cannot read the job", file, "");
  return {std::istreambuf_iterator<char>(in), {}};
}

void attempt(const std::string& file, const std::function<void()>& draw) {
  const io::VtkMessages messages;
  const std::string name = std::filesystem::path(file).filename().string();
  try {
    draw();
    std::cout << "file: " << file << std::endl;
    return;
  } catch (const std::exception& error) {
    std::cout << "note: no " << name << ": " << error.what();
  }
  const std::string vtk = messages.last();
  std::cout << (vtk.empty() ? "" : " (" + vtk + ")") << std::endl;
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: tessera-render JOB.json (the main program calls it)\n";
    return static_cast<int>(ExitStatus::bad_input);
  }
  require(std::getenv("DISPLAY") != nullptr, "there is no X server", "",
          "start it as 'xvfb-run -a tessera-render JOB'");
  const post::RenderJob job = post::render_job_from_json(content(argv[1]));
  // Ends when the program that asked would have ended it, should that one be killed.
  ::alarm(static_cast<unsigned>(post::time_limit(job)) + 30);
  for (const post::Drawing& drawing : job.drawings)
    attempt(drawing.file, [&] { post::draw_body(drawing); });
  for (const post::Plot& plot : job.plots)
    attempt(plot.file, [&] { post::draw_plot(plot); });
  for (const post::CellChart& chart : job.cell_charts)
    attempt(chart.file, [&] { post::draw_cell_chart(chart); });
  // Everything is written; graphics drivers are known to leak or crash on the way out.
  std::_Exit(0);
} catch (const tessera::Error& error) {
  std::cerr << "error: " << error.what() << '\n';
  return static_cast<int>(error.status());
}
