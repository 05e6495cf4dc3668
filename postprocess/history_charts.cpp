#include "postprocess/history_charts.hpp"

#include "core/history_columns.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace tessera::post {
namespace {

bool has(const io::History& history, const std::string& column) {
  return std::find(history.names.begin(), history.names.end(), column) != history.names.end();
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

/// What walls and supports did: names, and their columns that are there.
struct Forces {
  std::string name;
  std::vector<std::string> forces;   ///< N
  std::vector<std::string> pressure; ///< Pa, of a wall
};

std::vector<Forces> forces_of(const io::History& history) {
  std::vector<Forces> all;
  const auto add = [&](const std::string& column, const auto& endings) {
    if (!column.ends_with(endings[0]))
      return;
    Forces found{column.substr(0, column.size() - endings[0].size()), {}, {}};
    for (const std::string_view ending : endings)
      if (const std::string name = found.name + std::string(ending); has(history, name))
        (name.ends_with("_Pa") ? found.pressure : found.forces).push_back(name);
    all.push_back(std::move(found));
  };
  for (const std::string& column : history.names) {
    add(column, wall_columns);
    add(column, reaction_columns);
  }
  return all;
}

/// Those columns that are not zero, nor round-off beside the largest of them.
std::vector<std::string> telling(const io::History& history, const std::vector<std::string>& columns) {
  constexpr double noise = 1e-9;
  double most = 0;
  for (const std::string& column : columns)
    most = std::max(most, largest_magnitude(history.column(column)));
  std::vector<std::string> out;
  for (const std::string& column : columns)
    if (most > 0 && largest_magnitude(history.column(column)) > noise * most)
      out.push_back(column);
  return out;
}

Unit time_unit(const std::vector<NamedHistory>& runs) {
  double end = 0;
  for (const NamedHistory& run : runs)
    end = std::max(end, largest_magnitude(run.history->column("time_s")));
  return readable_unit("s", end);
}

/// Several columns of one run, all of one unit.
Chart chart_of(const std::string& title, const std::string& y_title, const std::vector<std::string>& columns,
               const io::History& history) {
  const Unit time = time_unit({{"", &history}});
  double most = 0;
  for (const std::string& column : columns)
    most = std::max(most, largest_magnitude(history.column(column)));
  const Unit unit = readable_unit(column_quantity(columns.front()).unit, most);
  Chart chart{title, titled("Time", time.name), titled(y_title, unit.name), false, false, {}};
  for (const std::string& column : columns)
    chart.curves.push_back({column_quantity(column).label, thinned(history.column("time_s"), time.factor),
                            thinned(history.column(column), unit.factor), false, false});
  return chart;
}

} // namespace

std::vector<std::string> probe_columns(const io::History& history) {
  std::vector<std::string> out;
  for (const std::string& name : history.names)
    if (std::find(history_columns.begin(), history_columns.end(), name) == history_columns.end())
      out.push_back(name);
  for (const Forces& one : forces_of(history))
    std::erase_if(out, [&](const std::string& name) {
      return std::count(one.forces.begin(), one.forces.end(), name) > 0 ||
             std::count(one.pressure.begin(), one.pressure.end(), name) > 0;
    });
  return out;
}

std::vector<std::string> force_columns(const io::History& history) {
  std::vector<std::string> out;
  for (const Forces& one : forces_of(history))
    for (const auto* columns : {&one.forces, &one.pressure})
      for (const std::string& column : telling(history, *columns))
        out.push_back(column);
  return out;
}

Chart chart_over_time(const std::string& title, const std::string& column,
                      const std::vector<NamedHistory>& runs) {
  const Quantity quantity = column_quantity(column);
  const Unit time = time_unit(runs);
  double most = 0;
  for (const NamedHistory& run : runs)
    most = std::max(most, largest_magnitude(run.history->column(column)));
  const Unit unit = readable_unit(quantity.unit, most);
  Chart chart{title, titled("Time", time.name), titled(quantity.label, unit.name), false, false, {}};
  for (const NamedHistory& run : runs) {
    const bool dashed = chart.curves.size() >= 8; // where the colours begin again
    chart.curves.push_back({run.name, thinned(run.history->column("time_s"), time.factor),
                            thinned(run.history->column(column), unit.factor), false, dashed});
  }
  return chart;
}

std::vector<Chart> energy_charts(const std::string& title, const io::History& history,
                                 const std::string& per) {
  std::vector<std::string> columns;
  double most = 0;
  for (const char* column :
       {"kinetic_J", "internal_J", "plastic_J", "dissipated_J", "external_J", "total_J"}) {
    if (!has(history, column) || largest_magnitude(history.column(column)) == 0)
      continue;
    columns.emplace_back(column);
    most = std::max(most, largest_magnitude(history.column(column)));
  }
  std::vector<Chart> charts;
  if (!columns.empty()) {
    charts.push_back(chart_of(title, "Energy" + per, columns, history));
    for (std::size_t i = 0; i < columns.size(); ++i)
      charts.back().curves[i].dashed = columns[i] == "total_J";
  }
  if (has(history, "balance_error") && largest_magnitude(history.column("balance_error")) > 0)
    charts.push_back(chart_over_time("Energy that is not accounted for, over the largest total",
                                     "balance_error", {{"", &history}}));
  return charts;
}

std::vector<Chart> momentum_charts(const std::string& title, const io::History& history,
                                   const std::string& per) {
  std::vector<Chart> charts;
  for (const auto& [name, ending] :
       {std::pair{"Linear momentum", "_kgm_s"}, {"Angular momentum", "_kgm2_s"}}) {
    std::vector<std::string> columns;
    for (const std::string_view column : history_columns)
      if (column.ends_with(ending) && has(history, std::string(column)) &&
          largest_magnitude(history.column(std::string(column))) > 0)
        columns.emplace_back(column);
    if (!columns.empty())
      charts.push_back(chart_of(charts.empty() ? title : "", name + per, columns, history));
  }
  return charts;
}

std::vector<Chart> force_charts(const io::History& history, const std::string& per) {
  std::vector<Chart> charts;
  for (const Forces& one : forces_of(history)) {
    if (const auto columns = telling(history, one.forces); !columns.empty()) {
      const std::string along =
          columns.size() > 1 ? "" : fmt::format(" along {}", columns.front().at(columns.front().size() - 3));
      charts.push_back(
          chart_of(column_quantity(one.name).label, "Force on the body" + along + per, columns, history));
    }
    for (const std::string& column : telling(history, one.pressure))
      charts.push_back(chart_over_time(column_quantity(column).label, column, {{"", &history}}));
  }
  return charts;
}

} // namespace tessera::post
