#include "preprocess/geometry/slab.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace tessera::preprocess {
namespace {

double twice_area(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Edge edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

std::string place(const Vec<2>& X, const std::string& origin) {
  return fmt::format("{} near ({:.6g}, {:.6g}) in the file's unit", origin, X[0], X[1]);
}

} // namespace

void find_sides(PlaneFigure& figure, const std::string& origin) {
  struct Use {
    Edge edge;
    std::int32_t triangle;
    int side;
    bool forward;
  };
  std::vector<Use> uses;
  uses.reserve(3 * figure.triangles.size());
  for (std::size_t t = 0; t < figure.triangles.size(); ++t) {
    auto& [a, b, c] = figure.triangles[t];
    const double area = twice_area(figure.vertices[a], figure.vertices[b], figure.vertices[c]);
    if (!(area != 0 && std::isfinite(area)))
      throw InputError(fmt::format("triangle {} of the plane mesh has no area", t + 1),
                       place(figure.vertices[a], origin), "repair or remesh the figure");
    if (area < 0)
      std::swap(b, c);
    for (int s = 0; s < 3; ++s) {
      const std::int32_t from = figure.triangles[t][s], to = figure.triangles[t][(s + 1) % 3];
      uses.push_back({edge_of(from, to), static_cast<std::int32_t>(t), s, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  std::vector<const Use*> single;
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].edge == uses[i].edge)
      ++j;
    const Vec<2> middle = (figure.vertices[uses[i].edge[0]] + figure.vertices[uses[i].edge[1]]) / 2;
    require(j - i <= 2, fmt::format("{} triangles of the plane mesh share one edge", j - i),
            place(middle, origin), "no part of the figure may lie on another");
    require(j - i == 1 || uses[i].forward != uses[i + 1].forward,
            "the plane figure folds over itself: two triangles lie on the same side of their edge",
            place(middle, origin), "no part of the figure may lie on another");
    if (j - i == 1)
      single.push_back(&uses[i]);
    i = j;
  }
  std::sort(single.begin(), single.end(), [](const Use* a, const Use* b) {
    return a->triangle != b->triangle ? a->triangle < b->triangle : a->side < b->side;
  });
  figure.sides.clear();
  for (const Use* use : single) {
    const Triangle& t = figure.triangles[use->triangle];
    figure.sides.push_back({{t[use->side], t[(use->side + 1) % 3]}, -1});
  }
}

void curves_by_angle(PlaneFigure& figure, double degrees) {
  std::vector<std::vector<std::int32_t>> at(figure.vertices.size());
  for (std::size_t s = 0; s < figure.sides.size(); ++s) {
    figure.sides[s].curve = -1;
    for (const std::int32_t v : figure.sides[s].vertices)
      at[v].push_back(static_cast<std::int32_t>(s));
  }
  const auto direction = [&](std::int32_t s) -> Vec<2> {
    return figure.vertices[figure.sides[s].vertices[1]] - figure.vertices[figure.sides[s].vertices[0]];
  };
  const auto smooth = [&](std::int32_t v) {
    if (at[v].size() != 2)
      return false;
    const Vec<2> a = direction(at[v][0]), b = direction(at[v][1]); // both run with the figure on their left
    const double kink = std::atan2(std::abs(a[0] * b[1] - a[1] * b[0]), a.dot(b)) * 180 / std::numbers::pi;
    return kink <= degrees;
  };
  figure.curves.clear();
  std::vector<std::int32_t> waiting;
  for (std::size_t seed = 0; seed < figure.sides.size(); ++seed) {
    if (figure.sides[seed].curve >= 0)
      continue;
    const auto curve = static_cast<std::int32_t>(figure.curves.size());
    figure.curves.push_back(fmt::format("edge{}", curve + 1));
    figure.sides[seed].curve = curve;
    waiting.push_back(static_cast<std::int32_t>(seed));
    while (!waiting.empty()) {
      const std::int32_t s = waiting.back();
      waiting.pop_back();
      for (const std::int32_t v : figure.sides[s].vertices) {
        if (!smooth(v))
          continue;
        for (const std::int32_t next : at[v])
          if (figure.sides[next].curve < 0) {
            figure.sides[next].curve = curve;
            waiting.push_back(next);
          }
      }
    }
  }
}

Domain draw_out(const PlaneFigure& figure) {
  Domain domain;
  domain.dimension = 2;
  const auto n = static_cast<std::int32_t>(figure.vertices.size());
  for (const double z : {0.5, -0.5})
    for (const Vec<2>& X : figure.vertices)
      domain.vertices.emplace_back(X[0], X[1], z);
  domain.tets.reserve(3 * figure.triangles.size());
  for (Triangle t : figure.triangles) {
    std::sort(t.begin(), t.end());
    const auto& [a, b, c] = t;
    // A staircase from the upper lid down to the lower, one vertex at a time.
    for (std::array<std::int32_t, 4> tet :
         {std::array{a, b, c, c + n}, std::array{a, b, b + n, c + n}, std::array{a, a + n, b + n, c + n}}) {
      domain.tets.push_back(tet);
      if (domain.tet_volume(domain.tets.size() - 1) < 0)
        std::swap(domain.tets.back()[2], domain.tets.back()[3]);
    }
  }
  std::map<Edge, std::int32_t> curve_of;
  for (const auto& side : figure.sides) {
    curve_of[edge_of(side.vertices[0], side.vertices[1])] = side.curve;
    domain.feature_edges.push_back({edge_of(side.vertices[0], side.vertices[1]), side.curve});
  }
  std::sort(domain.feature_edges.begin(), domain.feature_edges.end(),
            [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
  domain.surfaces = figure.curves;
  domain.facets = boundary_of(domain.tets);
  for (auto& facet : domain.facets) {
    const auto below =
        std::count_if(facet.vertices.begin(), facet.vertices.end(), [n](std::int32_t v) { return v >= n; });
    if (below == 0 || below == 3) {
      facet.surface = Domain::lid;
      continue;
    }
    std::int32_t low = n, high = -1; // a wall's facet has two vertices of the figure
    for (const std::int32_t v : facet.vertices) {
      low = std::min(low, v % n);
      high = std::max(high, v % n);
    }
    facet.surface = curve_of.at({low, high});
  }
  domain.measure();
  domain.cad_volume = domain.volume;
  return domain;
}

} // namespace tessera::preprocess
