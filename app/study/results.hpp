/// What a study came to: a row a run, what is worth its cost, and the files that say so.
#pragma once

#include "app/study/plan.hpp"
#include "app/study/run_store.hpp"
#include "core/progress.hpp"
#include "postprocess/document.hpp"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tessera::app {

/// NaN where a run has none.
struct Row {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::vector<std::string> labels;
  std::string id;
  double error = none;         ///< relative
  double cpu_seconds = none;   ///< of the steps
  double setup_seconds = none; ///< before them, processor time too
  double peak_bytes = none;
  double particles = none, steps = none;
  double spacing = none;         ///< nominal, m
  double spurious_energy = none; ///< share of its energy that a run gained or lost for no reason
  bool gave_up = false;          ///< the solver did: the run broke off
  std::string failure;           ///< why there are none; "not run" when it has not been yet

  std::string words() const; ///< the labels in a line
};

struct Recommendation {
  double target;      ///< relative error
  std::ptrdiff_t row; ///< the cheapest that keeps to it; -1: none does
};

struct Results {
  std::vector<Row> rows;
  std::vector<std::size_t> front; ///< of `rows`, by rising cost
  std::vector<Recommendation> recommendations;

  bool on_front(std::size_t row) const;
};

/// Reads what the store holds. `passing`: by id, why runs failed that the store does not keep as failures.
Results collect_results(const Study& study, const Plan& plan, const RunStore& store,
                        const std::map<std::string, std::string>& passing);

/// "error of the velocity", "error of the probe tip".
std::string error_words(const Study& study);

/// "1.5 %"; "-" of what is no number.
std::string percent(double error);

/// "for 1 % ...: ... costs ... s", one a target.
std::vector<std::string> recommendations_text(const Study& study, const Results& results);

std::string results_csv(const Study& study, const Results& results);
std::string results_json(const Study& study, const Results& results);

/// The whole of it for people; `pictures`: those that were drawn.
post::Document results_report(const Study& study, const Results& results,
                              const std::vector<std::filesystem::path>& pictures);

/// pareto.png, convergence.png where an axis is a size, and map.png where the study has one; in `folder`.
/// What could not be drawn, and why, is a note.
std::vector<std::filesystem::path> draw_results(const Study& study, const Results& results,
                                                const std::filesystem::path& folder, Progress& progress);

} // namespace tessera::app
