#include "app/study/grid.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tessera::app {
namespace {

constexpr std::size_t most_runs = 10'000;

bool excluded(const GridPoint& point, const Study& study) {
  return std::any_of(study.exclude.begin(), study.exclude.end(), [&](const Exclusion& exclusion) {
    return std::all_of(exclusion.begin(), exclusion.end(), [&](const auto& entry) {
      for (std::size_t i = 0; i < study.axes.size(); ++i)
        if (study.axes[i].name == entry.first)
          return std::find(entry.second.begin(), entry.second.end(), point.labels[i]) != entry.second.end();
      return false;
    });
  });
}

} // namespace

std::vector<GridPoint> expand_grid(const Study& study) {
  std::vector<GridPoint> points(1);
  for (const Axis& axis : study.axes) {
    require(points.size() * axis.values.size() <= most_runs,
            fmt::format("the grid has more than {} runs", most_runs), study.path.string(),
            "take fewer axes or values");
    std::vector<GridPoint> longer;
    for (const GridPoint& point : points)
      for (const AxisValue& value : axis.values) {
        GridPoint& next = longer.emplace_back(point);
        next.labels.push_back(value.label);
        next.assignments.insert(next.assignments.end(), value.assignments.begin(), value.assignments.end());
      }
    points = std::move(longer);
  }
  std::erase_if(points, [&](const GridPoint& point) { return excluded(point, study); });
  require(!points.empty(), "every run of the grid is excluded", study.path.string(),
          "let an [[exclude]] name more axes or fewer labels");
  return points;
}

} // namespace tessera::app
