// study.csv, study.json and what the program says at the end of a study.

#include "app/study/map.hpp"
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

/// "1 % error of the velocity"
std::string target_words(const Study& study, double target) {
  return fmt::format("{} {}", percent(target), error_words(study));
}

std::string recommendation(const Study& study, const Results& results, const Recommendation& r) {
  if (r.row < 0)
    return fmt::format("for {}: no run reaches it", target_words(study, r.target));
  const Row& row = results.rows[static_cast<std::size_t>(r.row)];
  return fmt::format("for {}: {} ({:.0f} particles) costs {} s, and {} s of set-up; its error is {}",
                     target_words(study, r.target), row.words(), row.particles, figure(row.cpu_seconds),
                     figure(row.setup_seconds), percent(row.error));
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json count(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(static_cast<std::int64_t>(value))
                              : nlohmann::ordered_json();
}

} // namespace

std::string Row::words() const {
  return fmt::format("{}", fmt::join(labels, ", "));
}

bool Results::on_front(std::size_t row) const {
  return std::find(front.begin(), front.end(), row) != front.end();
}

std::string percent(double error) {
  return std::isfinite(error) ? fmt::format("{} %", figure(100 * error)) : "-";
}

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

std::vector<std::string> recommendations_text(const Study& study, const Results& results) {
  std::vector<std::string> lines;
  for (const Recommendation& r : results.recommendations)
    lines.push_back(recommendation(study, results, r));
  return lines;
}

std::string results_csv(const Study& study, const Results& results) {
  std::vector<std::string> cells;
  for (const Axis& axis : study.axes)
    cells.push_back(axis.name);
  for (const char* column : {"particles", "spacing_m", "steps", "error", "cpu_seconds", "setup_seconds",
                             "peak_bytes", "spurious_energy", "verdict", "front", "run", "failure"})
    cells.emplace_back(column);
  std::string text = post::csv_line(cells);
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const Row& row = results.rows[i];
    cells = row.labels;
    for (const double value : {row.particles, row.spacing, row.steps, row.error, row.cpu_seconds,
                               row.setup_seconds, row.peak_bytes, row.spurious_energy})
      cells.push_back(std::isfinite(value) ? fmt::format("{}", value) : "");
    cells.insert(cells.end(), {verdict_word(verdict(row, study.map)), results.on_front(i) ? "1" : "0",
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
                            {"spacing", number(row.spacing)},
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

} // namespace tessera::app
