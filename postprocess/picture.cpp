#include "postprocess/picture.hpp"

#include "core/error.hpp"
#include "io/field_series.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render_job.hpp"
#include "postprocess/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

bool is_number(const std::string& text, double& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && std::isfinite(value);
}

/// A run to be drawn.
struct Run {
  fs::path folder;
  std::string label;
  std::vector<io::StoredFrame> frames;

  /// Its file of that name; empty where there is none.
  std::string file(const char* name) const {
    return fs::exists(folder / name) ? fs::absolute(folder / name).string() : "";
  }
};

/// The nearest frame, with a note where the run was over before, or had not begun.
const io::StoredFrame& frame_at(double time, const Picture& picture, const Run& run, Progress& progress) {
  const io::StoredFrame& nearest = chosen_frame(run.frames, fmt::format("{}", time));
  const double first = run.frames.front().time, last = run.frames.back().time;
  const double slack = 1e-3 * (last - first);
  if (time < first - slack || time > last + slack)
    progress.note(fmt::format("{}.png: the run's frames go from {} to {}: the {} one is drawn in place of {}",
                              picture.name, with_unit(first, "s"), with_unit(last, "s"),
                              time < first ? "first" : "last", with_unit(time, "s")));
  return nearest;
}

/// Which frames of a run a picture shows, in order of time.
std::vector<io::StoredFrame> frames_of(const Picture& picture, const Run& run, Progress& progress) {
  std::vector<io::StoredFrame> chosen;
  const auto add = [&](const io::StoredFrame& frame) { chosen.push_back(frame); };
  double time = 0;
  for (const double asked : picture.times)
    add(frame_at(asked, picture, run, progress));
  for (int k = 0; k < picture.frames; ++k)
    add(run.frames[static_cast<std::size_t>(k) * (run.frames.size() - 1) /
                   static_cast<std::size_t>(std::max(picture.frames - 1, 1))]);
  if (chosen.empty() && picture.animation)
    chosen = run.frames;
  else if (chosen.empty() && is_number(picture.frame, time))
    add(frame_at(time, picture, run, progress));
  else if (chosen.empty())
    add(chosen_frame(run.frames, picture.frame));
  std::sort(chosen.begin(), chosen.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return chosen;
}

/// Leaves out moments at which all runs show the frame they showed before.
void drop_repeated(std::vector<std::vector<io::StoredFrame>>& rows) {
  for (std::size_t k = rows.front().size(); k-- > 1;)
    if (std::all_of(rows.begin(), rows.end(),
                    [&](const auto& row) { return row[k].file == row[k - 1].file; }))
      for (auto& row : rows)
        row.erase(row.begin() + static_cast<std::ptrdiff_t>(k));
}

Drawing drawing_of(const Picture& picture, const std::vector<Run>& runs, const std::vector<Tool>& tools,
                   const fs::path& output, Progress& progress) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Drawing drawing;
  drawing.file = fs::absolute(output / (picture.name + ".png")).string();
  drawing.title = field_quantity(picture.field).label;
  drawing.field = picture.field;
  drawing.view = picture.view;
  drawing.minimum = picture.minimum.value_or(none);
  drawing.maximum = picture.maximum.value_or(none);
  drawing.outline = picture.outline;
  drawing.skin = picture.skin;
  if (picture.tools)
    drawing.tools = tools;
  std::vector<std::vector<io::StoredFrame>> rows;
  for (const Run& run : runs)
    rows.push_back(frames_of(picture, run, progress));
  if (!picture.animation)
    drop_repeated(rows);
  const std::size_t moments = rows.front().size();
  drawing.one_place = runs.size() == 1 || moments > 1;
  drawing.one_by_one = picture.animation;
  if (moments > 1 && !picture.animation)
    drawing.columns = static_cast<int>(moments);
  if (picture.magnify != 1)
    drawing.title += fmt::format(", displacements {:g} times as large", picture.magnify);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Run& run = runs[r];
    const std::string body = run.file("body.vtu"), cloud = run.file("cloud.vtp");
    if (picture.skin && (body.empty() || cloud.empty()))
      progress.note(fmt::format("{}.png: particles in place of a skin: there is no {} in {}", picture.name,
                                body.empty() ? "body.vtu" : "cloud.vtp", run.folder.string()));
    for (const io::StoredFrame& frame : rows[r])
      drawing.panels.push_back({fs::absolute(frame.file).string(), run.label, frame.time, 0, picture.clip, "",
                                body, cloud, picture.clip_at.value_or(none), picture.magnify});
  }
  return drawing;
}

} // namespace

std::vector<fs::path> draw(const std::vector<Picture>& pictures, const std::vector<fs::path>& folders,
                           const std::vector<std::string>& labels, const fs::path& output, Progress& progress,
                           const std::vector<Tool>& tools) {
  RenderJob job;
  try {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < folders.size(); ++i)
      runs.push_back({folders[i], i < labels.size() ? labels[i] : "", io::read_series(folders[i])});
    for (const Picture& picture : pictures)
      job.drawings.push_back(drawing_of(picture, runs, tools, output, progress));
  } catch (const Error& error) {
    progress.note(fmt::format("no pictures: {}", error.what()));
    return {};
  }
  return render(job, progress);
}

} // namespace tessera::post
