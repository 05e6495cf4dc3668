#include "app/study/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace tessera::app {
namespace {

bool sets_size(const AxisValue& value) {
  return std::any_of(value.assignments.begin(), value.assignments.end(), [](const std::string& assignment) {
    return assignment.starts_with("particles.count=") || assignment.starts_with("particles.spacing=");
  });
}

constexpr std::size_t least = 3;

/// Slope of the line through the last of (log x, log y) that is best in the least squares.
double order_of(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr double n = least;
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = x.size() - least; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void sort_by_spacing(Convergence& one) {
  std::vector<std::size_t> order(one.spacing.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return one.spacing[a] > one.spacing[b]; });
  const Convergence before = one;
  for (std::size_t i = 0; i < order.size(); ++i) {
    one.spacing[i] = before.spacing[order[i]];
    one.error[i] = before.error[order[i]];
  }
}

} // namespace

std::vector<Convergence> convergence(const Study& study, const Results& results) {
  const auto size = std::find_if(study.axes.begin(), study.axes.end(), [](const Axis& axis) {
    return std::all_of(axis.values.begin(), axis.values.end(), sets_size);
  });
  if (size == study.axes.end() || size->name == study.colour || size->name == study.marker)
    return {};
  std::vector<Convergence> all;
  for (const Row& row : results.rows) {
    if (!(row.error > 0) || !(row.spacing > 0) || !std::isfinite(row.error))
      continue;
    std::map<std::string, std::string> labels;
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      if (study.axes[a].name != size->name)
        labels[study.axes[a].name] = row.labels[a];
    auto one = std::find_if(all.begin(), all.end(), [&](const Convergence& c) { return c.labels == labels; });
    if (one == all.end())
      one = all.insert(all.end(), {labels, {}, {}, Row::none});
    one->spacing.push_back(row.spacing);
    one->error.push_back(row.error);
  }
  std::erase_if(all, [](const Convergence& one) { return one.spacing.size() < least; });
  for (Convergence& one : all) {
    sort_by_spacing(one);
    one.order = order_of(one.spacing, one.error);
  }
  return all;
}

} // namespace tessera::app
