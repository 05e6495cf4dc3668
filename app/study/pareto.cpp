#include "app/study/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::app {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> runs) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (std::isfinite(runs[i].cost) && std::isfinite(runs[i].error))
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return runs[a].cost < runs[b].cost || (runs[a].cost == runs[b].cost && runs[a].error < runs[b].error);
  });
  double best = std::numeric_limits<double>::infinity();
  std::erase_if(order, [&](std::size_t i) {
    if (runs[i].error >= best)
      return true;
    best = runs[i].error;
    return false;
  });
  return order;
}

std::optional<std::size_t> cheapest_within(std::span<const CostAndError> runs, double target) {
  for (const std::size_t i : pareto_front(runs))
    if (runs[i].error <= target)
      return i;
  return std::nullopt;
}

} // namespace tessera::app
