#include "postprocess/picture.hpp"

#include "core/error.hpp"
#include "io/field_series.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render_job.hpp"
#include "postprocess/snapshot.hpp"

#include <fmt/format.h>

#include <limits>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

Drawing drawing_of(const Picture& picture, const std::vector<std::vector<io::StoredFrame>>& series,
                   const std::vector<std::string>& labels, const fs::path& output) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Drawing drawing;
  drawing.file = fs::absolute(output / (picture.name + ".png")).string();
  drawing.title = field_quantity(picture.field).label;
  drawing.field = picture.field;
  drawing.view = picture.view;
  drawing.minimum = picture.minimum.value_or(none);
  drawing.maximum = picture.maximum.value_or(none);
  drawing.outline = picture.outline;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const io::StoredFrame& frame = chosen_frame(series[i], picture.frame);
    drawing.panels.push_back({fs::absolute(frame.file).string(), i < labels.size() ? labels[i] : "",
                              frame.time, 0, picture.clip, ""});
  }
  return drawing;
}

} // namespace

std::vector<fs::path> draw(const std::vector<Picture>& pictures, const std::vector<fs::path>& folders,
                           const std::vector<std::string>& labels, const fs::path& output,
                           Progress& progress) {
  RenderJob job;
  try {
    std::vector<std::vector<io::StoredFrame>> series;
    for (const fs::path& folder : folders)
      series.push_back(io::read_series(folder));
    for (const Picture& picture : pictures)
      job.drawings.push_back(drawing_of(picture, series, labels, output));
  } catch (const Error& error) {
    progress.note(fmt::format("no pictures: {}", error.what()));
    return {};
  }
  return render(job, progress);
}

} // namespace tessera::post
