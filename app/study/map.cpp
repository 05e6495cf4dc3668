#include "app/study/map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tessera::app {
namespace {

using Cell = post::CellChart::Cell;

/// Two digits are all a cell has room for.
std::string in_two_digits(double share) {
  const double value = 100 * share;
  if (value > 0 && value < 0.005)
    return "< 0.01 %";
  return value < 9999.5 ? fmt::format("{:.{}f} %", value,
                                      value >= 9.95    ? 0
                                      : value >= 0.995 ? 1
                                                       : 2)
                        : fmt::format("{:.0e} %", value);
}

Cell cell_of(const Row& row, const MapLayout& layout) {
  switch (verdict(row, layout)) {
  case Verdict::stable:
    return {Cell::Kind::within, std::log10(std::max(row.error, 1e-12) / layout.inaccurate),
            in_two_digits(row.error)};
  case Verdict::inaccurate:
    return {Cell::Kind::beyond, std::log10(row.error / layout.inaccurate), in_two_digits(row.error)};
  case Verdict::unstable:
    return {Cell::Kind::failed, 0, "unstable"};
  default:
    return {Cell::Kind::blank, 0, "-"};
  }
}

/// Names of axes have no blanks.
std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::size_t place_of(const std::vector<std::string>& labels, const std::string& label) {
  return static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
}

} // namespace

Verdict verdict(const Row& row, const MapLayout& layout) {
  if (row.gave_up || row.spurious_energy > layout.unbalanced)
    return Verdict::unstable;
  if (!std::isfinite(row.error))
    return Verdict::none;
  return row.error > layout.inaccurate ? Verdict::inaccurate : Verdict::stable;
}

std::string verdict_word(Verdict verdict) {
  switch (verdict) {
  case Verdict::stable:
    return "stable";
  case Verdict::inaccurate:
    return "inaccurate";
  case Verdict::unstable:
    return "unstable";
  default:
    return "";
  }
}

post::CellChart map_of(const Study& study, const Results& results) {
  post::CellChart chart;
  chart.title = study.title;
  chart.row_title = words(study.map.rows);
  chart.column_title = words(study.map.columns);
  chart.within = fmt::format("{} up to {}", error_words(study), in_two_digits(study.map.inaccurate));
  chart.beyond = "beyond: inaccurate";
  chart.failed =
      fmt::format("unstable: broke off, or {} of the energy spurious", in_two_digits(study.map.unbalanced));
  for (const Axis& axis : study.axes)
    for (const AxisValue& value : axis.values) {
      if (axis.name == study.map.rows)
        chart.rows.push_back(value.label);
      if (axis.name == study.map.columns)
        chart.columns.push_back(value.label);
    }
  std::vector<std::string> panels;
  for (const Row& row : results.rows) {
    std::vector<std::string> others;
    std::size_t r = 0, c = 0;
    for (std::size_t a = 0; a < study.axes.size(); ++a) {
      const std::string& name = study.axes[a].name;
      if (name == study.map.rows)
        r = place_of(chart.rows, row.labels[a]);
      else if (name == study.map.columns)
        c = place_of(chart.columns, row.labels[a]);
      else
        others.push_back(row.labels[a]);
    }
    const std::string title = fmt::format("{}", fmt::join(others, ", "));
    const std::size_t panel = place_of(panels, title);
    if (panel == panels.size()) {
      panels.push_back(title);
      chart.panels.push_back({title, std::vector<Cell>(chart.rows.size() * chart.columns.size())});
    }
    chart.panels[panel].cells[r * chart.columns.size() + c] = cell_of(row, study.map);
  }
  return chart;
}

} // namespace tessera::app
