/// What is worth its cost.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tessera::app {

/// NaN where a run has none.
struct CostAndError {
  double cost, error;
};

/// Those that no other beats: none is as cheap and as accurate and better in one of the two. In order of
/// cost; of runs alike in both the first.
std::vector<std::size_t> pareto_front(std::span<const CostAndError> runs);

/// The cheapest run whose error is at most `target`.
std::optional<std::size_t> cheapest_within(std::span<const CostAndError> runs, double target);

} // namespace tessera::app
