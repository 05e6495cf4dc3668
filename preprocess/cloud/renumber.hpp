/// Order along a Hilbert curve: particles near in space come near in memory.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <vector>

namespace tessera::preprocess {

/// The points' indices in the order a Hilbert curve through their bounding cube meets them (2^21 cells a
/// side, ties by index).
std::vector<std::int32_t> hilbert_order(const std::vector<Vec3>& points);

/// values[order[0]], values[order[1]], ...
template <class T>
std::vector<T> permuted(const std::vector<T>& values, const std::vector<std::int32_t>& order) {
  std::vector<T> result;
  result.reserve(order.size());
  for (const std::int32_t i : order)
    result.push_back(values[i]);
  return result;
}

} // namespace tessera::preprocess
