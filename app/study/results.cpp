#include "app/study/results.hpp"

#include "app/study/measure.hpp"
#include "app/study/pareto.hpp"
#include "app/study/stored_summary.hpp"
#include "core/error.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

using Failures = std::map<std::string, std::string>;

std::string why_missing(const std::string& id, const RunStore& store, const Failures& passing) {
  const auto passed = passing.find(id);
  return store.failure(id).value_or(passed != passing.end() ? passed->second : "not run");
}

/// Why nothing can be measured, or nothing.
std::string reference_failure(const Plan& plan, const RunStore& store, const Failures& passing) {
  if (!plan.finer || store.finished(plan.finer->id))
    return "";
  return fmt::format("no finer run: {}", why_missing(plan.finer->id, store, passing));
}

Row row_of(const PlannedRun& run, const RunStore& store, const Failures& passing,
           const std::optional<Measure>& measure, const std::string& unmeasured) {
  Row row;
  row.labels = run.labels;
  row.id = run.id;
  if (!store.finished(run.id)) {
    row.failure = why_missing(run.id, store, passing);
    row.gave_up = store.failure(run.id).has_value();
    return row;
  }
  try {
    const StoredSummary summary(store.run(run.id));
    row.cpu_seconds = summary.number("/cpu_seconds");
    row.setup_seconds = summary.number("/setup_seconds");
    row.peak_bytes = summary.number("/peak_bytes");
    row.particles = summary.number("/particles");
    row.steps = summary.number("/steps");
    row.spurious_energy = spurious_energy(store.run(run.id));
    if (measure)
      row.error = (*measure)(store.run(run.id));
    row.failure = unmeasured;
    if (measure && !std::isfinite(row.error))
      row.failure = "its error is no number";
  } catch (const Error& e) {
    row.failure = e.what();
  }
  return row;
}

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

} // namespace

Results collect_results(const Study& study, const Plan& plan, const RunStore& store,
                        const Failures& passing) {
  const std::string unmeasured = reference_failure(plan, store, passing);
  std::optional<Measure> measure;
  if (unmeasured.empty())
    measure.emplace(study.error, plan.column, plan.finer ? store.run(plan.finer->id) : fs::path());
  Results results;
  std::vector<CostAndError> costs;
  for (const PlannedRun& run : plan.runs) {
    results.rows.push_back(row_of(run, store, passing, measure, unmeasured));
    costs.push_back({results.rows.back().cpu_seconds, results.rows.back().error});
  }
  results.front = pareto_front(costs);
  for (const double target : study.error.targets) {
    const auto best = cheapest_within(costs, target);
    results.recommendations.push_back({target, best ? static_cast<std::ptrdiff_t>(*best) : -1});
  }
  return results;
}

bool draw_pareto(const Study& study, const Results& results, const fs::path& folder, Progress& progress) {
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
    return false;
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
  return !post::render({{}, {{fs::absolute(folder / "pareto.png").string(), {chart}}}}, progress).empty();
}

} // namespace tessera::app
