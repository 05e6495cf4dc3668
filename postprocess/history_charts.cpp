#include "postprocess/history_charts.hpp"

#include "core/history_columns.hpp"
#include "postprocess/quantity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace tessera::post {
namespace {

bool has(const io::History& history, const std::string& column) {
  return std::find(history.names.begin(), history.names.end(), column) != history.names.end();
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values)
    if (std::isfinite(v))
      most = std::max(most, std::abs(v));
  return most;
}

/// At most a few thousand of the values, the last among them: more than a picture can show.
std::vector<double> thinned(const std::vector<double>& values, double factor) {
  const std::size_t stride = values.size() / 4000 + 1;
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); i += stride)
    out.push_back(factor * values[i]);
  if (!values.empty() && (values.size() - 1) % stride != 0)
    out.push_back(factor * values.back());
  return out;
}

Unit time_unit(const std::vector<NamedHistory>& runs) {
  double end = 0;
  for (const NamedHistory& run : runs)
    end = std::max(end, largest(run.history->column("time_s")));
  return readable_unit("s", end);
}

} // namespace

std::vector<std::string> probe_columns(const io::History& history) {
  std::vector<std::string> out;
  for (const std::string& name : history.names)
    if (std::find(history_columns.begin(), history_columns.end(), name) == history_columns.end())
      out.push_back(name);
  return out;
}

Chart chart_over_time(const std::string& title, const std::string& column,
                      const std::vector<NamedHistory>& runs) {
  const Quantity quantity = column_quantity(column);
  const Unit time = time_unit(runs);
  double most = 0;
  for (const NamedHistory& run : runs)
    most = std::max(most, largest(run.history->column(column)));
  const Unit unit = readable_unit(quantity.unit, most);
  Chart chart{title, titled("Time", time.name), titled(quantity.label, unit.name), false, false, {}};
  for (const NamedHistory& run : runs) {
    const bool dashed = chart.curves.size() >= 8; // where the colours begin again
    chart.curves.push_back({run.name, thinned(run.history->column("time_s"), time.factor),
                            thinned(run.history->column(column), unit.factor), false, dashed});
  }
  return chart;
}

std::vector<Chart> energy_charts(const std::string& title, const io::History& history) {
  const std::vector<NamedHistory> run{{"", &history}};
  const Unit time = time_unit(run);
  std::vector<std::string> columns;
  double most = 0;
  for (const char* column :
       {"kinetic_J", "internal_J", "plastic_J", "dissipated_J", "external_J", "total_J"}) {
    if (!has(history, column) || largest(history.column(column)) == 0)
      continue;
    columns.emplace_back(column);
    most = std::max(most, largest(history.column(column)));
  }
  std::vector<Chart> charts;
  if (!columns.empty()) {
    const Unit unit = readable_unit("J", most);
    Chart chart{title, titled("Time", time.name), titled("Energy", unit.name), false, false, {}};
    for (const std::string& column : columns)
      chart.curves.push_back({column_quantity(column).label, thinned(history.column("time_s"), time.factor),
                              thinned(history.column(column), unit.factor), false, column == "total_J"});
    charts.push_back(std::move(chart));
  }
  if (has(history, "balance_error") && largest(history.column("balance_error")) > 0)
    charts.push_back(
        chart_over_time("Energy that is not accounted for, over the largest total", "balance_error", run));
  return charts;
}

} // namespace tessera::post
