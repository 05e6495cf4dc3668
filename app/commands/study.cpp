#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/run_folder.hpp"
#include "app/study/map.hpp"
#include "app/study/plan.hpp"
#include "app/study/results.hpp"
#include "app/study/run_store.hpp"
#include "app/study/study_file.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "io/atomic_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

/// Those not run yet, each content once: what the others are held against comes first.
std::vector<RunToDo> runs_to_do(const Plan& plan, const RunStore& store) {
  std::vector<const PlannedRun*> all;
  if (plan.finer)
    all.push_back(&*plan.finer);
  for (const PlannedRun& run : plan.runs)
    all.push_back(&run);
  std::vector<RunToDo> missing;
  std::set<std::string> seen;
  for (const PlannedRun* run : all)
    if (seen.insert(run->id).second && store.missing(run->id))
      missing.push_back({run->id, run->words, run->work});
  return missing;
}

void store_cases(const Study& study, const Plan& plan, const RunStore& store, bool retry) {
  const auto keep = [&](const PlannedRun& run) {
    if (!fs::exists(store.case_file(run.id)))
      store_input(store.case_file(run.id), study.case_file, {}, run.text);
    if (retry)
      store.forget_failure(run.id);
  };
  for (const PlannedRun& run : plan.runs)
    keep(run);
  if (plan.finer)
    keep(*plan.finer);
}

} // namespace

void study(const Options& options) {
  Console console(options);
  const Study study = read_study(options.case_file);
  const Plan plan = plan_study(study, options.overrides);
  const fs::path folder =
      fs::absolute(options.output.empty() ? fs::path("runs") / study.name : options.output)
          .lexically_normal();
  open_folder(folder, true);
  store_input(folder / "study.toml", study.path, options.overrides, study.text);
  io::make_output_folder(folder / "cases");
  const RunStore store(folder);
  store_cases(study, plan, store, options.retry);

  const std::vector<RunToDo> missing = runs_to_do(plan, store);
  console.progress().note(fmt::format("{}: {} runs, {} of them to do, in {}", study.title, plan.runs.size(),
                                      missing.size(), folder.string()));
  const auto passing = run_all(missing, store, threads(), study.time_limit, console.progress());

  const Results results = collect_results(study, plan, store, passing);
  io::write_text(folder / "study.csv", results_csv(study, results));
  io::write_text(folder / "study.json", results_json(study, results));
  if (interrupted()) {
    const std::size_t left = runs_to_do(plan, store).size();
    throw RunError("interrupted", fmt::format("{} of {} runs left to do", left, plan.runs.size()),
                   "run the same command again to go on");
  }
  const std::vector<fs::path> pictures = draw_results(study, results, folder, console.progress());
  const post::Document report = results_report(study, results, pictures);
  io::write_text(folder / "report.md", post::markdown(report));
  io::write_text(folder / "report.html", post::html(report, folder));

  const auto measured = std::count_if(results.rows.begin(), results.rows.end(),
                                      [](const Row& row) { return std::isfinite(row.error); });
  if (measured == 0)
    throw RunError(
        fmt::format("no run of the study has an error, the first: {}", results.rows.front().failure),
        folder.string(), "see report.md there");
  std::string files = "study.csv, study.json, report.md, report.html";
  for (const fs::path& picture : pictures)
    files += fmt::format(", {}", picture.filename().string());
  console.result(fmt::format("{}: {} run{} measured, {} without an error\n{}\nresults in {}: {}\n",
                             study.title, measured, measured == 1 ? "" : "s",
                             results.rows.size() - static_cast<std::size_t>(measured),
                             fmt::join(recommendations_text(study, results), "\n"), folder.string(), files),
                 results_json(study, results));
}

} // namespace tessera::app
