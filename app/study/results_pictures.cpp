// pareto.png, convergence.png and map.png.

#include "app/study/convergence.hpp"
#include "app/study/map.hpp"
#include "app/study/results.hpp"
#include "postprocess/render_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

/// The values of the axes that tell curves apart, in their order: (colour, marker) to places on the axes.
std::size_t place_on(const Study& study, const std::string& axis_name, const Row& row) {
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const Axis& axis = study.axes[a];
    if (axis.name != axis_name)
      continue;
    const auto found = std::find_if(axis.values.begin(), axis.values.end(),
                                    [&](const AxisValue& value) { return value.label == row.labels[a]; });
    return static_cast<std::size_t>(found - axis.values.begin());
  }
  return 0;
}

const Axis& axis_named(const Study& study, const std::string& name) {
  return *std::find_if(study.axes.begin(), study.axes.end(),
                       [&](const Axis& axis) { return axis.name == name; });
}

/// Names without points: one a colour and, where another axis has the markers, one a marker.
std::vector<post::Curve> legend(const Study& study) {
  std::vector<post::Curve> entries;
  const bool two = study.colour != study.marker;
  const auto add = [&](const std::string& label, std::size_t colour, std::size_t marker) {
    post::Curve& entry = entries.emplace_back();
    entry.label = label;
    entry.dots = true;
    entry.colour = static_cast<int>(colour);
    entry.marker = static_cast<int>(marker);
  };
  const auto& colours = axis_named(study, study.colour).values;
  for (std::size_t i = 0; i < colours.size(); ++i)
    add(colours[i].label, i, two ? 0 : i);
  const auto& markers = axis_named(study, study.marker).values;
  for (std::size_t i = 0; two && i < markers.size(); ++i)
    add(markers[i].label, static_cast<std::size_t>(post::Curve::grey), i);
  return entries;
}

/// Error against cost.
std::optional<post::Chart> pareto(const Study& study, const Results& results) {
  const std::string cost = "Processor time of the steps (s)";
  post::Chart chart{study.title, cost, fmt::format("Relative {}", error_words(study)), true, true, {}};
  std::map<std::pair<std::size_t, std::size_t>, post::Curve> curves;
  for (const Row& row : results.rows) {
    if (!std::isfinite(row.error) || row.error <= 0)
      continue;
    const std::size_t colour = place_on(study, study.colour, row),
                      marker = place_on(study, study.marker, row);
    post::Curve& curve = curves[{colour, marker}];
    curve.dots = true;
    curve.colour = static_cast<int>(colour);
    curve.marker = static_cast<int>(marker);
    curve.x.push_back(row.cpu_seconds);
    curve.y.push_back(row.error);
  }
  if (curves.empty())
    return std::nullopt;
  post::Curve front;
  front.label = "front";
  front.dashed = true;
  front.colour = post::Curve::grey;
  for (const std::size_t i : results.front) {
    front.x.push_back(results.rows[i].cpu_seconds);
    front.y.push_back(results.rows[i].error);
  }
  chart.curves.push_back(std::move(front));
  for (post::Curve& entry : legend(study))
    chart.curves.push_back(std::move(entry));
  for (auto& [place, curve] : curves)
    chart.curves.push_back(std::move(curve));
  return chart;
}

/// Dashed lines of the first and the second order through the coarsest of the best errors.
void add_slopes(post::Chart& chart) {
  double finest = std::numeric_limits<double>::infinity(), coarsest = 0, error = finest;
  for (const post::Curve& curve : chart.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      finest = std::min(finest, curve.x[i]);
      if (curve.x[i] > coarsest || (curve.x[i] == coarsest && curve.y[i] < error)) {
        coarsest = curve.x[i];
        error = curve.y[i];
      }
    }
  for (const int order : {1, 2}) {
    post::Curve& slope = chart.curves.emplace_back();
    slope.label = order == 1 ? "slopes 1 and 2" : "";
    slope.dashed = true;
    slope.colour = post::Curve::grey;
    slope.x = {coarsest, finest};
    slope.y = {error, error * std::pow(finest / coarsest, order)};
  }
}

/// Error against spacing: one chart a marker, beside them lines of the first and the second order.
std::vector<post::Chart> convergence_charts(const Study& study, const Results& results) {
  const bool two = study.colour != study.marker;
  const auto& colours = axis_named(study, study.colour).values;
  std::map<std::string, post::Chart> charts; // by marker
  for (const Convergence& one : convergence(study, results)) {
    const std::string marker = two ? one.labels.at(study.marker) : study.title;
    const auto colour = std::find_if(colours.begin(), colours.end(), [&](const AxisValue& value) {
      return value.label == one.labels.at(study.colour);
    });
    post::Curve line;
    line.label = fmt::format("{}: order {:.2f}", colour->label, one.order);
    line.x = one.spacing;
    line.y = one.error;
    line.colour = static_cast<int>(colour - colours.begin());
    post::Curve dots = line;
    dots.label.clear();
    dots.dots = true;
    auto& curves = charts[marker].curves;
    curves.insert(curves.end(), {line, dots});
  }
  std::vector<post::Chart> out;
  const auto add = [&](const std::string& title) {
    const auto found = charts.find(title);
    if (found == charts.end())
      return;
    post::Chart& chart = out.emplace_back(std::move(found->second));
    chart.title = title;
    chart.x_title = "Spacing (m)";
    chart.y_title = fmt::format("Relative {}", error_words(study));
    chart.log_x = chart.log_y = true;
    add_slopes(chart);
  };
  if (!two)
    add(study.title);
  for (const AxisValue& marker : axis_named(study, study.marker).values)
    if (two)
      add(marker.label);
  return out;
}

} // namespace

std::vector<fs::path> draw_results(const Study& study, const Results& results, const fs::path& folder,
                                   Progress& progress) {
  post::RenderJob job;
  const auto add = [&](const char* name, std::vector<post::Chart> charts) {
    job.plots.push_back({fs::absolute(folder / name).string(), std::move(charts), false});
  };
  if (auto chart = pareto(study, results))
    add("pareto.png", {std::move(*chart)});
  if (auto charts = convergence_charts(study, results); !charts.empty())
    add("convergence.png", std::move(charts));
  if (study.map.drawn) {
    post::CellChart map = map_of(study, results);
    map.file = fs::absolute(folder / "map.png").string();
    job.cell_charts.push_back(std::move(map));
  }
  return post::render(job, progress);
}

} // namespace tessera::app
