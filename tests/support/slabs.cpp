#include "tests/support/slabs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

namespace tessera::test {
namespace {

using preprocess::Domain;
using preprocess::PlaneFigure;
using Node = std::array<int, 2>;

/// Squares of an integer grid for which `filled` holds, two triangles each, nodes put where `place` says.
PlaneFigure grid_figure(const Node& squares, const std::function<bool(const Node&)>& filled,
                        const std::function<Node(const Node&)>& same_as,
                        const std::function<Vec<2>(const Node&)>& place) {
  PlaneFigure figure;
  std::map<Node, std::int32_t> numbers;
  const auto number = [&](const Node& node) {
    const auto [at, added] =
        numbers.try_emplace(same_as(node), static_cast<std::int32_t>(figure.vertices.size()));
    if (added)
      figure.vertices.push_back(place(same_as(node)));
    return at->second;
  };
  for (int j = 0; j < squares[1]; ++j)
    for (int i = 0; i < squares[0]; ++i) {
      if (!filled({i, j}))
        continue;
      const std::int32_t a = number({i, j}), b = number({i + 1, j}), c = number({i + 1, j + 1}),
                         d = number({i, j + 1});
      figure.triangles.push_back({a, b, c});
      figure.triangles.push_back({a, c, d});
    }
  return figure;
}

Node itself(const Node& node) {
  return node;
}

} // namespace

Domain slab_of(PlaneFigure figure) {
  preprocess::find_sides(figure, "test figure");
  preprocess::curves_by_angle(figure, 30);
  Domain domain = preprocess::draw_out(figure);
  std::map<std::int32_t, std::set<std::int32_t>> walls_at;
  for (const auto& side : figure.sides)
    for (const std::int32_t v : side.vertices)
      walls_at[v].insert(side.curve);
  for (const auto& [vertex, walls] : walls_at)
    if (walls.size() > 1)
      domain.corners.push_back(vertex);
  return domain;
}

Domain square_slab(int n, double scale, const Vec<2>& offset) {
  return slab_of(grid_figure(
      {n, n}, [](const Node&) { return true; }, itself,
      [&](const Node& p) -> Vec<2> { return offset + scale * Vec<2>(p[0], p[1]) / n; }));
}

Domain l_slab(int n, double scale, const Vec<2>& offset) {
  return slab_of(grid_figure(
      {2 * n, 2 * n}, [&](const Node& p) { return p[0] < n || p[1] < n; }, itself,
      [&](const Node& p) -> Vec<2> { return offset + scale * Vec<2>(p[0], p[1]) / n; }));
}

Domain holed_slab(int n, double scale, const Vec<2>& offset) {
  const int around = 8 * n, rings = n;
  return slab_of(grid_figure(
      {around, rings}, [](const Node&) { return true; },
      [&](const Node& p) {
        return Node{p[0] % around, p[1]};
      },
      [&](const Node& p) -> Vec<2> {
        const double angle = 2 * std::numbers::pi * p[0] / around;
        const Vec<2> direction(std::cos(angle), std::sin(angle));
        Vec<2> outer = direction * (0.5 / direction.cwiseAbs().maxCoeff());
        for (double& x : outer)
          if (std::abs(std::abs(x) - 0.5) < 1e-12)
            x = std::copysign(0.5, x);
        const double t = static_cast<double>(p[1]) / rings;
        return offset + scale * (Vec<2>::Constant(0.5) + (1 - t) * 0.3 * direction + t * outer);
      }));
}

Domain slotted_slab(int n, double width) {
  const auto x = [&](int i) {
    return i <= n ? static_cast<double>(i) / n : 1 + width + static_cast<double>(i - n - 1) / n;
  };
  return slab_of(grid_figure(
      {2 * n + 1, n + 1}, [&](const Node& p) { return p[1] == 0 || p[0] != n; }, itself,
      [&](const Node& p) -> Vec<2> {
        return {x(p[0]), p[1] == 0 ? -0.2 : static_cast<double>(p[1] - 1) / n};
      }));
}

} // namespace tessera::test
