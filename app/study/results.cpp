#include "app/study/results.hpp"

#include "app/study/measure.hpp"
#include "app/study/pareto.hpp"
#include "app/study/stored_summary.hpp"
#include "core/error.hpp"

#include <fmt/format.h>

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
    row.spacing = summary.number("/spacing");
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

} // namespace tessera::app
