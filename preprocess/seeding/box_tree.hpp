/// Boxes in a binary tree: which hold a point, which item lies nearest to it.
#pragma once

#include "core/tensor.hpp"

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tessera::preprocess {

struct Box {
  Vec3 lower, upper;

  bool meets(const Box& other) const {
    return (other.upper.array() >= lower.array()).all() && (other.lower.array() <= upper.array()).all();
  }
  double squared_distance(const Vec3& x) const {
    return (lower - x).cwiseMax(x - upper).cwiseMax(0.0).squaredNorm();
  }
};

/// Immutable once built: any number of threads may ask at once.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// The first item found whose box meets `with` (a point is a box) and for which test(item) is true; -1
  /// where there is none.
  template <class Test>
  std::int32_t find(const Box& with, Test&& test) const {
    std::int32_t stack[most_depth];
    int depth = 0;
    if (!nodes_.empty())
      stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!node.box.meets(with))
        continue;
      if (node.right >= 0) {
        stack[depth++] = node.right;
        stack[depth++] = static_cast<std::int32_t>(&node - nodes_.data()) + 1;
        continue;
      }
      for (std::int32_t k = node.begin; k < node.end; ++k)
        if (boxes_[order_[k]].meets(with) && test(order_[k]))
          return order_[k];
    }
    return -1;
  }

  /// The nearest item (the lowest of equals) and its squared distance, which squared_distance(item) gives and
  /// which its box bounds from below. (-1, infinity) where there is no item.
  template <class Distance>
  std::pair<std::int32_t, double> nearest(const Vec3& x, Distance&& squared_distance) const {
    std::pair<std::int32_t, double> best{-1, std::numeric_limits<double>::infinity()};
    std::pair<double, std::int32_t> stack[most_depth]; // squared distance of the node's box, node
    int depth = 0;
    if (!nodes_.empty())
      stack[depth++] = {nodes_[0].box.squared_distance(x), 0};
    while (depth > 0) {
      const auto [bound, at] = stack[--depth];
      if (bound > best.second)
        continue;
      const Node& node = nodes_[at];
      if (node.right >= 0) {
        std::pair<double, std::int32_t> first{nodes_[at + 1].box.squared_distance(x), at + 1};
        std::pair<double, std::int32_t> second{nodes_[node.right].box.squared_distance(x), node.right};
        if (second.first < first.first)
          std::swap(first, second);
        stack[depth++] = second;
        stack[depth++] = first;
        continue;
      }
      for (std::int32_t k = node.begin; k < node.end; ++k) {
        const std::int32_t item = order_[k];
        if (boxes_[item].squared_distance(x) > best.second)
          continue;
        const double distance = squared_distance(item);
        if (distance < best.second || (distance == best.second && item < best.first))
          best = {item, distance};
      }
    }
    return best;
  }

 private:
  static constexpr int most_depth = 64; ///< halving 2^31 items ends long before

  struct Node {
    Box box;
    std::int32_t begin, end; ///< into order_
    std::int32_t right;      ///< second child (the first comes next), -1: a leaf
  };
  void build(std::int32_t begin, std::int32_t end);

  std::vector<Box> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

} // namespace tessera::preprocess
