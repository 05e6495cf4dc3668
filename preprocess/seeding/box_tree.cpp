#include "preprocess/seeding/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace tessera::preprocess {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes_.empty())
    build(0, static_cast<std::int32_t>(boxes_.size()));
}

void BoxTree::build(std::int32_t begin, std::int32_t end) {
  Box whole = boxes_[order_[begin]];
  for (std::int32_t k = begin + 1; k < end; ++k) {
    whole.lower = whole.lower.cwiseMin(boxes_[order_[k]].lower);
    whole.upper = whole.upper.cwiseMax(boxes_[order_[k]].upper);
  }
  const std::size_t node = nodes_.size();
  nodes_.push_back({whole, begin, end, -1});
  if (end - begin <= 4)
    return;
  int axis;
  (whole.upper - whole.lower).maxCoeff(&axis);
  const auto middle_of = [&](std::int32_t item) {
    return boxes_[item].lower[axis] + boxes_[item].upper[axis];
  };
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) {
                     const double x = middle_of(a), y = middle_of(b);
                     return x != y ? x < y : a < b;
                   });
  build(begin, middle);
  nodes_[node].right = static_cast<std::int32_t>(nodes_.size());
  build(middle, end);
}

} // namespace tessera::preprocess
