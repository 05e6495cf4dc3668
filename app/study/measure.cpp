#include "app/study/measure.hpp"

#include "app/study/stored_summary.hpp"
#include "core/error.hpp"
#include "io/history.hpp"
#include "postprocess/field_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

TimeSeries series(const io::History& history, const std::string& time, const std::string& column) {
  return {history.column(time), history.column(column)};
}

TimeSeries series(const ErrorMeasure::History& given) {
  TimeSeries truth;
  try {
    truth = series(io::read_history(given.file), given.time_column, given.column);
  } catch (const InputError& e) {
    throw InputError(e.what(), fmt::format("error.history of the study, {}", given.file.string()), "");
  }
  for (double& t : truth.time)
    t *= given.time_factor;
  for (double& v : truth.value)
    v *= given.factor;
  return truth;
}

double interpolated(const TimeSeries& s, double t) {
  const auto after = std::upper_bound(s.time.begin(), s.time.end(), t) - s.time.begin();
  const auto b = std::min(static_cast<std::size_t>(after), s.time.size() - 1), a = b > 0 ? b - 1 : 0;
  const double width = s.time[b] - s.time[a];
  return width > 0 ? s.value[a] + (s.value[b] - s.value[a]) * (t - s.time[a]) / width : s.value[b];
}

} // namespace

double history_error(const TimeSeries& run, const TimeSeries& truth, ErrorMeasure::Norm norm) {
  require(!run.time.empty() && run.time.size() == run.value.size(), "the run's history is empty", "", "");
  const double slack = 1e-9 * std::abs(run.time.back());
  double worst = 0, scale = 0, squares = 0, true_squares = 0, last = 0, last_truth = 0;
  double t_before = 0, d_before = 0, v_before = 0;
  int used = 0;
  for (std::size_t i = 0; i < truth.time.size(); ++i) {
    const double t = truth.time[i], v = truth.value[i];
    if (t < run.time.front() - slack || t > run.time.back() + slack)
      continue;
    const double d = interpolated(run, std::clamp(t, run.time.front(), run.time.back())) - v;
    if (!std::isfinite(d))
      return std::numeric_limits<double>::quiet_NaN();
    worst = std::max(worst, std::abs(d));
    scale = std::max(scale, std::abs(v));
    if (used++ > 0) {
      squares += 0.5 * (d * d + d_before * d_before) * (t - t_before);
      true_squares += 0.5 * (v * v + v_before * v_before) * (t - t_before);
    }
    t_before = t, d_before = d, v_before = v;
    last = std::abs(d), last_truth = std::abs(v);
  }
  require(used >= 2, "the reference's times lie outside of the run's", "",
          "check its time column and factor");
  switch (norm) {
  case ErrorMeasure::Norm::worst:
    return worst / scale;
  case ErrorMeasure::Norm::rms:
    return std::sqrt(squares / true_squares);
  default:
    return last / last_truth;
  }
}

double spurious_energy(const fs::path& folder) {
  if (!fs::exists(folder / "history.csv"))
    return std::numeric_limits<double>::quiet_NaN();
  const io::History history = io::read_history(folder / "history.csv");
  const std::vector<double>&total = history.column("total_J"), &dissipated = history.column("dissipated_J"),
        &external = history.column("external_J");
  double given = 0, spurious = 0;
  for (std::size_t i = 0; i < total.size(); ++i) {
    given = std::max(given, total.front() + external[i]);
    spurious = std::max({spurious, std::abs(total[i] - total.front()), -dissipated[i]});
  }
  return given > 0 ? spurious / given : std::numeric_limits<double>::quiet_NaN();
}

Measure::Measure(const ErrorMeasure& measure, std::string column, const fs::path& finer)
    : measure_(measure), column_(std::move(column)), finer_(finer) {
  if (measure.history)
    truth_ = series(*measure.history);
  else if (measure.of == ErrorMeasure::Of::probe && measure.finer)
    truth_ = series(io::read_history(finer / "history.csv"), "time_s", column_);
}

double Measure::operator()(const fs::path& folder) const {
  if (measure_.of == ErrorMeasure::Of::closed_form)
    return StoredSummary(folder).number(fmt::format("/error/l2_{}_relative", measure_.name));
  if (measure_.of == ErrorMeasure::Of::field)
    return of_field(folder);
  if (measure_.value)
    return std::abs(StoredSummary(folder).number("/probes/" + column_) - *measure_.value) /
           std::abs(*measure_.value);
  return history_error(series(io::read_history(folder / "history.csv"), "time_s", column_), *truth_,
                       measure_.norm);
}

double Measure::of_field(const fs::path& folder) const {
  const std::string field = measure_.name == "displacement" ? "Displacement"
                            : measure_.name == "velocity"   ? "Velocity"
                                                            : "Pressure";
  const post::Difference difference =
      post::differences_from_first({post::read_snapshot(finer_), post::read_snapshot(folder)}, {field})
          .back();
  require(difference.points > 0, "none of the finer run's particles lies in the body of this one",
          folder.string(), "let [error.finer] keep the geometry");
  return difference.fields.front().relative.value_or(std::numeric_limits<double>::quiet_NaN());
}

} // namespace tessera::app
