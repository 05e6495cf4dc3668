// study.csv, study.json, report.md and what the program says at the end of a study.

#include "app/study/map.hpp"
#include "app/study/pareto.hpp"
#include "app/study/results.hpp"
#include "postprocess/csv.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tessera::app {
namespace {

using post::figure;

std::string percent(double error) {
  return std::isfinite(error) ? fmt::format("{} %", figure(100 * error)) : "-";
}

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string words_of(const Row& row) {
  return fmt::format("{}", fmt::join(row.labels, ", "));
}

bool on_front(const Results& results, std::size_t i) {
  return std::find(results.front.begin(), results.front.end(), i) != results.front.end();
}

std::string table_head(const Study& study, bool marked) {
  std::string names, rule;
  for (const Axis& axis : study.axes) {
    names += fmt::format(" {} |", markdown_cell(axis.name));
    rule += ":--|";
  }
  return fmt::format("|{}{} particles | steps | error | stepping, CPU s | set-up, CPU s | memory, MB |\n"
                     "|{}{}--:|--:|--:|--:|--:|--:|\n",
                     marked ? " front |" : "", names, marked ? ":--|" : "", rule);
}

std::string table_row(const Row& row) {
  std::string text;
  for (const std::string& label : row.labels)
    text += fmt::format(" {} |", markdown_cell(label));
  return text + fmt::format(" {:.0f} | {:.0f} | {} | {} | {} | {:.0f} |\n", row.particles, row.steps,
                            percent(row.error), figure(row.cpu_seconds), figure(row.setup_seconds),
                            row.peak_bytes / 1e6);
}

/// "1 % error of the velocity"
std::string target_words(const Study& study, double target) {
  return fmt::format("{} {}", percent(target), error_words(study));
}

std::string recommendation(const Study& study, const Results& results, const Recommendation& r) {
  if (r.row < 0)
    return fmt::format("for {}: no run reaches it", target_words(study, r.target));
  const Row& row = results.rows[static_cast<std::size_t>(r.row)];
  return fmt::format("for {}: {} ({:.0f} particles) costs {} s, and {} s of set-up; its error is {}",
                     target_words(study, r.target), words_of(row), row.particles, figure(row.cpu_seconds),
                     figure(row.setup_seconds), percent(row.error));
}

/// Of each value of the axis that has the colours the cheapest run that keeps to each target.
std::string table_by_colour(const Study& study, const Results& results) {
  const auto axis = std::find_if(study.axes.begin(), study.axes.end(),
                                 [&](const Axis& a) { return a.name == study.colour; });
  const auto place = static_cast<std::size_t>(axis - study.axes.begin());
  std::string head = fmt::format("| {} |", markdown_cell(axis->name)), rule = "|:--|", rows;
  for (const double target : study.error.targets) {
    head += fmt::format(" {} |", percent(target));
    rule += ":--|";
  }
  for (const AxisValue& value : axis->values) {
    std::vector<CostAndError> costs;
    for (const Row& row : results.rows)
      costs.push_back({row.labels[place] == value.label ? row.cpu_seconds : Row::none, row.error});
    rows += fmt::format("| {} |", markdown_cell(value.label));
    for (const double target : study.error.targets) {
      const auto best = cheapest_within(costs, target);
      if (!best) {
        rows += " - |";
        continue;
      }
      const Row& row = results.rows[*best];
      std::vector<std::string> others = row.labels;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(place));
      rows += fmt::format(" {} s{}{} |", figure(row.cpu_seconds), others.empty() ? "" : ": ",
                          markdown_cell(fmt::format("{}", fmt::join(others, ", "))));
    }
    rows += "\n";
  }
  return fmt::format("{}\n{}\n{}", head, rule, rows);
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json count(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(static_cast<std::int64_t>(value))
                              : nlohmann::ordered_json();
}

} // namespace

std::string error_words(const Study& study) {
  switch (study.error.of) {
  case ErrorMeasure::Of::closed_form:
    return fmt::format("{} error", study.error.name);
  case ErrorMeasure::Of::field:
    return fmt::format("{} error against the finer run", study.error.name);
  default:
    return fmt::format("error of {}", study.error.name);
  }
}

std::string recommendations_text(const Study& study, const Results& results) {
  std::string text;
  for (const Recommendation& r : results.recommendations)
    text += recommendation(study, results, r) + "\n";
  return text;
}

std::string results_csv(const Study& study, const Results& results) {
  std::vector<std::string> cells;
  for (const Axis& axis : study.axes)
    cells.push_back(axis.name);
  for (const char* column : {"particles", "steps", "error", "cpu_seconds", "setup_seconds", "peak_bytes",
                             "spurious_energy", "verdict", "front", "run", "failure"})
    cells.emplace_back(column);
  std::string text = post::csv_line(cells);
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const Row& row = results.rows[i];
    cells = row.labels;
    for (const double value : {row.particles, row.steps, row.error, row.cpu_seconds, row.setup_seconds,
                               row.peak_bytes, row.spurious_energy})
      cells.push_back(std::isfinite(value) ? fmt::format("{}", value) : "");
    cells.insert(cells.end(), {verdict_word(verdict(row, study.map)), on_front(results, i) ? "1" : "0",
                               "runs/" + row.id, row.failure});
    text += post::csv_line(cells);
  }
  return text;
}

std::string results_json(const Study& study, const Results& results) {
  using Json = nlohmann::ordered_json;
  Json json{
      {"title", study.title},        {"version", TESSERA_VERSION},      {"case", study.case_file.string()},
      {"error", error_words(study)}, {"axes", Json::array()},           {"runs", Json::array()},
      {"front", results.front},      {"recommendations", Json::array()}};
  for (const Axis& axis : study.axes) {
    Json labels = Json::array();
    for (const AxisValue& value : axis.values)
      labels.push_back(value.label);
    json["axes"].push_back({{"name", axis.name}, {"values", labels}});
  }
  for (const Row& row : results.rows) {
    Json labels = Json::object();
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      labels[study.axes[a].name] = row.labels[a];
    json["runs"].push_back({{"labels", labels},
                            {"particles", count(row.particles)},
                            {"steps", count(row.steps)},
                            {"error", number(row.error)},
                            {"cpu_seconds", number(row.cpu_seconds)},
                            {"setup_seconds", number(row.setup_seconds)},
                            {"peak_bytes", count(row.peak_bytes)},
                            {"spurious_energy", number(row.spurious_energy)},
                            {"verdict", verdict_word(verdict(row, study.map))},
                            {"folder", "runs/" + row.id},
                            {"failure", row.failure.empty() ? Json() : Json(row.failure)}});
  }
  for (const Recommendation& r : results.recommendations)
    json["recommendations"].push_back({{"target", r.target}, {"run", r.row < 0 ? Json() : Json(r.row)}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string results_markdown(const Study& study, const Results& results,
                             const std::vector<std::string>& pictures) {
  std::string text = fmt::format("# {}\n\n", study.title);
  for (const Recommendation& r : results.recommendations)
    text += fmt::format("- {}\n", recommendation(study, results, r));
  for (const std::string& picture : pictures)
    text += fmt::format("\n![{}]({})\n",
                        picture == "map.png" ? "Where runs are stable" : "Error against cost", picture);
  text +=
      fmt::format("\nCost is processor time on one thread, so that it means the same on a busy machine: of "
                  "the steps, without what is written;\nset-up, from the geometry to the operators, apart. "
                  "Errors are relative. Each run is in `runs/`, named in study.csv.\n\n"
                  "## The cheapest by {} and error\n{}\n"
                  "## What is worth its cost\nNo other run is as cheap and as accurate.\n\n{}",
                  study.colour, table_by_colour(study, results), table_head(study, false));
  for (const std::size_t i : results.front)
    text += fmt::format("|{}", table_row(results.rows[i]));
  std::vector<std::size_t> order;
  std::string failures;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const Row& row = results.rows[i];
    if (std::isfinite(row.cpu_seconds))
      order.push_back(i);
    if (!row.failure.empty())
      failures += fmt::format("- {}: {}\n", words_of(row), row.failure);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return results.rows[a].cpu_seconds < results.rows[b].cpu_seconds;
  });
  text += fmt::format("\n## All runs, by cost\n{}", table_head(study, true));
  for (const std::size_t i : order)
    text += fmt::format("| {} |{}", on_front(results, i) ? "*" : "", table_row(results.rows[i]));
  if (!failures.empty())
    text += fmt::format("\n## Without an error\n{}", failures);
  return text;
}

} // namespace tessera::app
