#include "tests/support/domains.hpp"

#include "preprocess/geometry/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

namespace tessera::test {
namespace {

using preprocess::Domain;
using Cell = std::array<int, 3>;

/// Plane of the grid a boundary facet lies in, as the name of the surface.
struct Plane {
  int axis, index;
  bool operator<(const Plane& o) const { return std::tie(axis, index) < std::tie(o.axis, o.index); }
};

/// Feature edges where two surfaces meet, corners where three do, the measures; facets know their surfaces.
void finish(Domain& domain) {
  std::map<std::int32_t, std::set<std::int32_t>> surfaces_at;                   // of a vertex
  std::map<std::array<std::int32_t, 2>, std::set<std::int32_t>> surfaces_along; // of an edge
  for (const auto& facet : domain.facets)
    for (int e = 0; e < 3; ++e) {
      const auto [v, w] = std::minmax(facet.vertices[e], facet.vertices[(e + 1) % 3]);
      surfaces_at[facet.vertices[e]].insert(facet.surface);
      surfaces_along[{v, w}].insert(facet.surface);
    }
  std::map<std::set<std::int32_t>, std::int32_t> curves;
  for (const auto& [edge, pair] : surfaces_along)
    if (pair.size() == 2)
      domain.feature_edges.push_back(
          {edge, curves.try_emplace(pair, static_cast<std::int32_t>(curves.size())).first->second});
  for (const auto& [v, around] : surfaces_at)
    if (around.size() >= 3)
      domain.corners.push_back(v);
  domain.measure();
  domain.cad_volume = domain.volume;
}

/// Cuts a grid cell into six tetrahedra around its diagonal (1,1,1).
template <class Number>
void add_cell(const Cell& cell, const Number& number, Domain& domain) {
  std::array<int, 3> order{0, 1, 2};
  do {
    Cell p = cell;
    std::array<std::int32_t, 4> tet{number(p), 0, 0, 0};
    for (int step = 0; step < 3; ++step) {
      ++p[order[step]];
      tet[step + 1] = number(p);
    }
    domain.tets.push_back(tet);
    if (domain.tet_volume(domain.tets.size() - 1) < 0)
      std::swap(domain.tets.back()[2], domain.tets.back()[3]);
  } while (std::next_permutation(order.begin(), order.end()));
}

/// Cells of an integer grid for which `filled` holds, each cut into six tetrahedra around the diagonal
/// (1,1,1), so that neighbours agree on every shared face.
Domain grid_domain(const Cell& cells, const std::function<bool(const Cell&)>& filled,
                   const std::map<Plane, std::string>& names, const std::function<Vec3(const Cell&)>& place) {
  Domain domain;
  std::map<Cell, std::int32_t> numbers;
  std::vector<Cell> points;
  const auto number = [&](const Cell& p) {
    const auto [it, added] = numbers.try_emplace(p, static_cast<std::int32_t>(points.size()));
    if (added) {
      points.push_back(p);
      domain.vertices.push_back(place(p));
    }
    return it->second;
  };
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        if (filled({i, j, k}))
          add_cell({i, j, k}, number, domain);

  domain.facets = preprocess::boundary_of(domain.tets);
  std::map<Plane, std::int32_t> surface_of;
  for (const auto& [plane, name] : names) {
    const auto s = static_cast<std::int32_t>(domain.surfaces.size());
    surface_of[plane] = s;
    domain.surfaces.push_back(name);
    domain.groups.push_back({name, 2, {s}, {}, {}});
  }
  for (auto& facet : domain.facets) {
    const auto& [a, b, c] = facet.vertices;
    for (int axis = 0; axis < 3; ++axis)
      if (points[a][axis] == points[b][axis] && points[a][axis] == points[c][axis])
        facet.surface = surface_of.at({axis, points[a][axis]});
  }
  finish(domain);
  return domain;
}

} // namespace

Domain box_domain(const Vec3& lower, const Vec3& upper, int n) {
  return grid_domain(
      {n, n, n}, [](const Cell&) { return true; },
      {{{0, 0}, "xmin"},
       {{0, n}, "xmax"},
       {{1, 0}, "ymin"},
       {{1, n}, "ymax"},
       {{2, 0}, "zmin"},
       {{2, n}, "zmax"}},
      [&](const Cell& p) {
        Vec3 X;
        for (int c = 0; c < 3; ++c)
          X[c] = p[c] == n ? upper[c] : lower[c] + (upper[c] - lower[c]) * p[c] / n;
        return X;
      });
}

Domain l_domain(int n, double scale, const Vec3& offset) {
  return grid_domain(
      {2 * n, 2 * n, n}, [&](const Cell& c) { return c[0] < n || c[1] < n; },
      {{{0, 0}, "xmin"},
       {{0, n}, "notch_x"},
       {{0, 2 * n}, "xmax"},
       {{1, 0}, "ymin"},
       {{1, n}, "notch_y"},
       {{1, 2 * n}, "ymax"},
       {{2, 0}, "zmin"},
       {{2, n}, "zmax"}},
      [&](const Cell& p) -> Vec3 { return offset + scale * Vec3(p[0], p[1], p[2]) / n; });
}

Domain holed_domain(int n) {
  const int around = 8 * n;
  Domain domain;
  const auto number = [&](const Cell& p) {
    return static_cast<std::int32_t>(p[0] % around + around * (p[1] + (n + 1) * p[2]));
  };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around, t = static_cast<double>(j) / n;
        Vec3 direction(std::cos(angle), std::sin(angle), 0);
        Vec3 outer = direction * (0.5 / direction.cwiseAbs().maxCoeff());
        for (double& x : outer)
          if (std::abs(std::abs(x) - 0.5) < 1e-12)
            x = std::copysign(0.5, x);
        domain.vertices.push_back(Vec3(0.5, 0.5, 0.5 * k / n) + (1 - t) * 0.3 * direction + t * outer);
      }
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < around; ++i)
        add_cell({i, j, k}, number, domain);
  domain.facets = preprocess::boundary_of(domain.tets);
  domain.surfaces = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax", "bore"};
  for (std::int32_t s = 0; s < 7; ++s)
    domain.groups.push_back({domain.surfaces[s], 2, {s}, {}, {}});
  const Vec3 upper(1, 1, 0.5);
  for (auto& facet : domain.facets) {
    facet.surface = 6;
    for (int axis = 0; axis < 3; ++axis)
      for (const bool far : {false, true})
        if (std::all_of(facet.vertices.begin(), facet.vertices.end(),
                        [&](std::int32_t v) { return domain.vertices[v][axis] == (far ? upper[axis] : 0); }))
          facet.surface = 2 * axis + far;
  }
  finish(domain);
  return domain;
}

Domain slotted_domain(int n, double width, double scale) {
  const auto along = [n](int p) { return static_cast<double>(p) / n; };
  return grid_domain(
      {2 * n + 1, n + 1, n}, [&](const Cell& c) { return c[1] == 0 || c[0] != n; },
      {{{0, 0}, "xmin"},
       {{0, n}, "slot_left"},
       {{0, n + 1}, "slot_right"},
       {{0, 2 * n + 1}, "xmax"},
       {{1, 0}, "ymin"},
       {{1, 1}, "slot_foot"},
       {{1, n + 1}, "ymax"},
       {{2, 0}, "zmin"},
       {{2, n}, "zmax"}},
      [&](const Cell& p) -> Vec3 {
        const double x = p[0] <= n ? along(p[0]) : 1 + width + along(p[0] - n - 1);
        return scale * Vec3(x, p[1] == 0 ? -0.2 : along(p[1] - 1), along(p[2]));
      });
}

} // namespace tessera::test
