// The report of a study.

#include "app/study/convergence.hpp"
#include "app/study/pareto.hpp"
#include "app/study/results.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tessera::app {
namespace {

using post::figure;

/// Rows of results; `marked`: with a column that tells which are on the front.
post::Table table_of(const Study& study, const Results& results, const std::vector<std::size_t>& rows,
                     bool marked) {
  post::Table table;
  if (marked)
    table.header.emplace_back("front");
  for (const Axis& axis : study.axes)
    table.header.push_back(axis.name);
  table.words = table.header.size();
  for (const char* column : {"particles", "steps", "error", "stepping, CPU s", "set-up, CPU s", "memory, MB"})
    table.header.emplace_back(column);
  for (const std::size_t i : rows) {
    const Row& row = results.rows[i];
    auto& cells = table.rows.emplace_back();
    if (marked)
      cells.emplace_back(results.on_front(i) ? "*" : "");
    cells.insert(cells.end(), row.labels.begin(), row.labels.end());
    for (std::string cell :
         {fmt::format("{:.0f}", row.particles), fmt::format("{:.0f}", row.steps), percent(row.error),
          figure(row.cpu_seconds), figure(row.setup_seconds), fmt::format("{:.0f}", row.peak_bytes / 1e6)})
      cells.push_back(std::move(cell));
  }
  return table;
}

/// Of each value of the axis that has the colours the cheapest run that keeps to each target.
post::Table table_by_colour(const Study& study, const Results& results) {
  const auto axis = std::find_if(study.axes.begin(), study.axes.end(),
                                 [&](const Axis& a) { return a.name == study.colour; });
  const auto place = static_cast<std::size_t>(axis - study.axes.begin());
  post::Table table{{axis->name}, {}};
  for (const double target : study.error.targets)
    table.header.push_back(percent(target));
  table.words = table.header.size();
  for (const AxisValue& value : axis->values) {
    std::vector<CostAndError> costs;
    for (const Row& row : results.rows)
      costs.push_back({row.labels[place] == value.label ? row.cpu_seconds : Row::none, row.error});
    auto& cells = table.rows.emplace_back(std::vector{value.label});
    for (const double target : study.error.targets) {
      const auto best = cheapest_within(costs, target);
      if (!best) {
        cells.emplace_back("-");
        continue;
      }
      const Row& row = results.rows[*best];
      std::vector<std::string> others = row.labels;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(place));
      cells.push_back(fmt::format("{} s{}{}", figure(row.cpu_seconds), others.empty() ? "" : ": ",
                                  fmt::join(others, ", ")));
    }
  }
  return table;
}

post::Table table_of_orders(const Study& study, const std::vector<Convergence>& all) {
  post::Table table;
  for (const Axis& axis : study.axes)
    if (all.front().labels.contains(axis.name))
      table.header.push_back(axis.name);
  table.words = table.header.size();
  for (const char* column : {"sizes", "finest spacing, m", "its error", "order"})
    table.header.emplace_back(column);
  for (const Convergence& one : all) {
    auto& cells = table.rows.emplace_back();
    for (std::size_t i = 0; i < table.words; ++i)
      cells.push_back(one.labels.at(table.header[i]));
    for (std::string cell : {fmt::format("{}", one.spacing.size()), figure(one.spacing.back()),
                             percent(one.error.back()), fmt::format("{:.2f}", one.order)})
      cells.push_back(std::move(cell));
  }
  return table;
}

} // namespace

post::Document results_report(const Study& study, const Results& results,
                              const std::vector<std::filesystem::path>& pictures) {
  post::Document report{study.title, {}};
  const auto heading = [&](std::string text) { report.blocks.push_back(post::Heading{2, std::move(text)}); };
  const auto paragraph = [&](std::string text) { report.blocks.push_back(post::Paragraph{std::move(text)}); };
  const auto picture = [&](const char* name) {
    for (const auto& file : pictures)
      if (file.filename() == name)
        report.blocks.push_back(post::Image{name});
  };
  for (std::string& line : recommendations_text(study, results))
    paragraph(std::move(line));
  picture("pareto.png");
  paragraph("Cost is processor time on one thread, so that it means the same on a busy machine: of the "
            "steps, without what is written; set-up, from the geometry to the operators, apart. Errors are "
            "relative. Each run is in `runs/`, named in study.csv.");
  if (study.map.drawn) {
    heading("Where runs are stable");
    picture("map.png");
  }
  heading(fmt::format("The cheapest by {} and error", study.colour));
  report.blocks.push_back(table_by_colour(study, results));
  heading("What is worth its cost");
  paragraph("No other run is as cheap and as accurate.");
  report.blocks.push_back(table_of(study, results, results.front, false));
  if (const std::vector<Convergence> all = convergence(study, results); !all.empty()) {
    heading("Convergence");
    picture("convergence.png");
    paragraph("The order is the slope of the line through the logarithms of error and spacing of the three "
              "finest sizes, best in the least squares.");
    report.blocks.push_back(table_of_orders(study, all));
  }
  std::vector<std::size_t> order;
  post::Table failures{{"run", "why"}, {}, 2};
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const Row& row = results.rows[i];
    if (std::isfinite(row.cpu_seconds))
      order.push_back(i);
    if (!row.failure.empty())
      failures.rows.push_back({row.words(), row.failure});
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return results.rows[a].cpu_seconds < results.rows[b].cpu_seconds;
  });
  heading("All runs, by cost");
  report.blocks.push_back(table_of(study, results, order, true));
  if (!failures.rows.empty()) {
    heading("Without an error");
    report.blocks.push_back(std::move(failures));
  }
  heading("The study");
  report.blocks.push_back(post::Verbatim{study.text});
  return report;
}

} // namespace tessera::app
