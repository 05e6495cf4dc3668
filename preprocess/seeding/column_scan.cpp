#include "preprocess/seeding/column_scan.hpp"

#include "preprocess/seeding/nearness.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tessera::preprocess {
namespace {

/// A chord c that turns by the angle t has the height c/2 tan(t/4).
double chord_height(double half_chord, const Vec3& before, const Vec3& after) {
  return half_chord * std::tan(std::acos(std::clamp(before.dot(after), -1.0, 1.0)) / 4);
}

Vec3 flat(const Vec3& X) {
  return {X.x(), X.y(), 0};
}

} // namespace

BoundaryBands::BoundaryBands(const Domain& domain, const CadTopology& cad) : domain_(domain), cad_(cad) {
  const auto facets = static_cast<std::int32_t>(domain.facets.size());
  normals_.reserve(facets);
  for (std::int32_t f = 0; f < facets; ++f) {
    const auto X = corners(f);
    normals_.push_back((X[1] - X[0]).cross(X[2] - X[0]).normalized());
  }
  if (domain.dimension == 2) {
    find_rim_bulges();
    return;
  }
  bulge_.reserve(facets);
  for (std::int32_t f = 0; f < facets; ++f)
    bulge_.push_back(facet_bulge(f));
}

std::array<Vec3, 3> BoundaryBands::corners(std::int32_t facet) const {
  const auto& v = domain_.facets[facet].vertices;
  return {domain_.vertices[v[0]], domain_.vertices[v[1]], domain_.vertices[v[2]]};
}

double BoundaryBands::facet_bulge(std::int32_t f) const {
  const auto X = corners(f);
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t g = cad_.smooth_across(f)[k];
    if (g < 0)
      continue;
    const Vec3 side = (X[(k + 1) % 3] - X[k]).normalized();
    const Vec3 apex = X[(k + 2) % 3] - X[k];
    most = std::max(most, chord_height((apex - apex.dot(side) * side).norm() / 2, normals_[f], normals_[g]));
  }
  return most;
}

void BoundaryBands::find_rim_bulges() {
  const auto& rim = domain_.feature_edges;
  rim_bulge_.assign(rim.size(), 0);
  std::map<std::int32_t, std::vector<std::size_t>> around; // edges at the rim's smooth vertices
  for (std::size_t e = 0; e < rim.size(); ++e)
    for (const std::int32_t v : rim[e].vertices)
      if (!cad_.is_corner(v))
        around[v].push_back(e);
  for (const auto& [v, edges] : around) {
    if (edges.size() != 2)
      continue;
    const auto away = [&](std::size_t e) -> Vec3 {
      const auto& ends = rim[e].vertices;
      return domain_.vertices[ends[0] == v ? ends[1] : ends[0]] - domain_.vertices[v];
    };
    const Vec3 to = away(edges[0]), from = away(edges[1]);
    for (const Vec3& chord : {to, from}) {
      double& bulge = rim_bulge_[edges[&chord == &from]];
      bulge = std::max(bulge, chord_height(chord.norm() / 2, to.normalized(), -from.normalized()));
    }
  }
}

ColumnScan::ColumnScan(const BoundaryBands& bands, const Lattice& frame, const Sublattice& part)
    : bands_(bands), frame_(frame), part_(part) {
  for (int a = 0; a < 3; ++a)
    counts_[a] = std::max(0, (frame.counts[a] - part.first[a] + part.step[a] - 1) / part.step[a]);
  columns_ = std::int64_t{counts_[0]} * counts_[1];
  const bool plane = bands.domain().dimension == 2;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(bands.domain().facets.size()); ++f) {
    cross(bands.corners(f));
    if (!plane)
      mark_facet(f);
  }
  if (plane)
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(bands.domain().feature_edges.size()); ++e)
      mark_rim(e);
  sort_crossings();
  sort_band();
}

std::int64_t ColumnScan::count() const {
  std::int64_t total = 0;
  each_column([&](std::int64_t, const std::vector<Run>& runs) {
    for (const auto& [first, last] : runs)
      total += last - first + 1;
  });
  return total;
}

void ColumnScan::emit(Lattice& lattice) const {
  const std::int64_t total = count() + static_cast<std::int64_t>(lattice.index.size());
  lattice.index.reserve(total);
  lattice.place.resize(total, CadPlace{static_cast<std::uint8_t>(bands_.domain().dimension), -1});
  auto on = band_.begin();
  each_column([&](std::int64_t column, const std::vector<Run>& runs) {
    const auto i = part_.first[0] + part_.step[0] * static_cast<std::int32_t>(column / counts_[1]);
    const auto j = part_.first[1] + part_.step[1] * static_cast<std::int32_t>(column % counts_[1]);
    for (const auto& [first, last] : runs) {
      const auto base = static_cast<std::int64_t>(lattice.index.size()) - first;
      for (std::int32_t k = first; k <= last; ++k)
        lattice.index.push_back({i, j, part_.first[2] + part_.step[2] * k});
      for (; on != band_.end() && on->key <= column * counts_[2] + last; ++on)
        lattice.place[base + on->key % counts_[2]] = on->place;
    }
  });
}

/// Indices along an axis that may lie in [low, high], one more on either side.
ColumnScan::Run ColumnScan::range(int axis, double low, double high) const {
  const auto index = [&](double x) {
    return std::clamp((x - at(axis, 0)) / (frame_.unit[axis] * part_.step[axis]), -2.0, counts_[axis] + 1.0);
  };
  return {std::max(0, static_cast<std::int32_t>(std::floor(index(low)))),
          std::min(counts_[axis] - 1, static_cast<std::int32_t>(std::ceil(index(high))))};
}

double ColumnScan::band(double bulge) const {
  return std::clamp(bulge, lattice_band * frame_.spec.spacing, 0.25 * frame_.spec.spacing);
}

void ColumnScan::mark(const std::array<std::int32_t, 3>& index, const CadPlace& place) {
  const std::int64_t column = std::int64_t{index[0]} * counts_[1] + index[1];
  band_.push_back({column * counts_[2] + index[2], place});
}

/// Adds the heights at which columns cross a triangle.
void ColumnScan::cross(const std::array<Vec3, 3>& X) {
  std::array<Point2, 3> p;
  for (int k = 0; k < 3; ++k)
    p[k] = {X[k].x(), X[k].y()};
  const int turn = orientation(p[0], p[1], p[2]);
  if (turn == 0)
    return; // seen edge-on: a column beside it crosses its neighbours
  const Vec3 normal = (X[1] - X[0]).cross(X[2] - X[0]);
  const auto [x_low, x_high] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [y_low, y_high] = std::minmax({p[0].y, p[1].y, p[2].y});
  const auto [z_low, z_high] = std::minmax({X[0].z(), X[1].z(), X[2].z()});
  const Run is = range(0, x_low, x_high);
  for (std::int32_t i = is.first; i <= is.second; ++i) {
    const double x = at(0, i);
    // Part of the row that can lie inside: between the crossings of the row with the sides.
    double low = y_high, high = y_low;
    for (int k = 0; k < 3; ++k) {
      const Point2 &a = p[k], &b = p[(k + 1) % 3];
      if (std::min(a.x, b.x) > x || std::max(a.x, b.x) < x)
        continue;
      const double t = a.x == b.x ? 0 : (x - a.x) / (b.x - a.x);
      for (const double y :
           {a.x == b.x ? b.y : a.y + t * (b.y - a.y), a.x == b.x ? a.y : b.y - (1 - t) * (b.y - a.y)}) {
        low = std::min(low, y);
        high = std::max(high, y);
      }
    }
    if (low > high)
      continue;
    const Run js = range(1, low, high);
    for (std::int32_t j = js.first; j <= js.second; ++j) {
      const Point2 here{x, at(1, j)};
      if (orientation_perturbed(p[0], p[1], here) != turn ||
          orientation_perturbed(p[1], p[2], here) != turn || orientation_perturbed(p[2], p[0], here) != turn)
        continue;
      const double z =
          X[0].z() - (normal.x() * (here.x - p[0].x) + normal.y() * (here.y - p[0].y)) / normal.z();
      crossings_.push_back({std::int64_t{i} * counts_[1] + j, std::clamp(z, z_low, z_high)});
    }
  }
}

/// Marks the lattice points within the band of a facet.
void ColumnScan::mark_facet(std::int32_t f) {
  const auto X = bands_.corners(f);
  const Vec3& normal = bands_.normal(f);
  const double near = band(bands_.bulge(f));
  // Look along the axis the facet faces most: on each line at most a point or two lie near its plane.
  int w;
  normal.cwiseAbs().maxCoeff(&w);
  const int u = (w + 1) % 3, v = (w + 2) % 3;
  const auto extent = [&](int axis) {
    const auto [low, high] = std::minmax({X[0][axis], X[1][axis], X[2][axis]});
    return range(axis, low - near, high + near);
  };
  const Run us = extent(u), vs = extent(v);
  std::array<std::int32_t, 3> index{};
  for (index[u] = us.first; index[u] <= us.second; ++index[u])
    for (index[v] = vs.first; index[v] <= vs.second; ++index[v]) {
      const double plane =
          X[0][w] -
          (normal[u] * (at(u, index[u]) - X[0][u]) + normal[v] * (at(v, index[v]) - X[0][v])) / normal[w];
      const double reach = near / std::abs(normal[w]);
      const Run ws = range(w, plane - reach, plane + reach);
      for (index[w] = ws.first; index[w] <= ws.second; ++index[w]) {
        const Vec3 p(at(0, index[0]), at(1, index[1]), at(2, index[2]));
        if (std::abs(p[w] - plane) > reach || (p - nearest_on_triangle(p, X)).squaredNorm() > near * near)
          continue;
        mark(index, place(p, f, X, near));
      }
    }
}

CadPlace ColumnScan::place(const Vec3& p, std::int32_t f, const std::array<Vec3, 3>& X, double near) const {
  const auto& facet = bands_.domain().facets[f];
  for (int k = 0; k < 3; ++k)
    if (bands_.cad().is_corner(facet.vertices[k]) && (p - X[k]).squaredNorm() <= near * near)
      return {0, facet.vertices[k]};
  for (int k = 0; k < 3; ++k)
    if (const std::int32_t curve = bands_.cad().curves_around(f)[k];
        curve >= 0 && squared_distance_to_segment(p, X[k], X[(k + 1) % 3]) <= near * near)
      return {1, curve};
  return {2, facet.surface};
}

/// As mark_facet, along a piece of a plane body's rim.
void ColumnScan::mark_rim(std::int32_t e) {
  const auto& edge = bands_.domain().feature_edges[e];
  const Vec3 a = flat(bands_.domain().vertices[edge.vertices[0]]);
  const Vec3 b = flat(bands_.domain().vertices[edge.vertices[1]]);
  const double near = band(bands_.rim_bulge(e));
  const Vec3 along = (b - a).cwiseAbs();
  const int u = along.x() > along.y() ? 0 : 1, v = 1 - u; // go along u: few points lie near on each line
  const double reach = near * along.norm() / along[u];
  std::array<std::int32_t, 3> index{};
  const Run us = range(u, std::min(a[u], b[u]) - near, std::max(a[u], b[u]) + near);
  for (index[u] = us.first; index[u] <= us.second; ++index[u]) {
    const double t = std::clamp((at(u, index[u]) - a[u]) / (b[u] - a[u]), 0.0, 1.0);
    const double middle = a[v] + t * (b[v] - a[v]);
    const Run vs = range(v, middle - reach, middle + reach);
    for (index[v] = vs.first; index[v] <= vs.second; ++index[v]) {
      const Vec3 p(at(0, index[0]), at(1, index[1]), 0);
      if (squared_distance_to_segment(p, a, b) > near * near)
        continue;
      CadPlace place{1, edge.curve};
      for (const std::int32_t c : edge.vertices)
        if (bands_.cad().is_corner(c) && (p - flat(bands_.domain().vertices[c])).squaredNorm() <= near * near)
          place = {0, c};
      mark(index, place);
    }
  }
}

void ColumnScan::sort_crossings() {
  rows_.assign(columns_ + 1, 0);
  for (const auto& crossing : crossings_)
    ++rows_[crossing.first + 1];
  for (std::int64_t c = 0; c < columns_; ++c)
    rows_[c + 1] += rows_[c];
  heights_.resize(crossings_.size());
  std::vector<std::int64_t> fill(rows_.begin(), rows_.end() - 1);
  for (const auto& [column, z] : crossings_)
    heights_[fill[column]++] = z;
  for (std::int64_t c = 0; c < columns_; ++c)
    std::sort(heights_.begin() + rows_[c], heights_.begin() + rows_[c + 1]);
  crossings_ = {};
}

/// One entry a point: the place of lowest dimension.
void ColumnScan::sort_band() {
  std::sort(band_.begin(), band_.end(), [](const OnBoundary& a, const OnBoundary& b) {
    if (a.key != b.key)
      return a.key < b.key;
    if (a.place.dimension != b.place.dimension)
      return a.place.dimension < b.place.dimension;
    return a.place.entity < b.place.entity;
  });
  band_.erase(std::unique(band_.begin(), band_.end(),
                          [](const OnBoundary& a, const OnBoundary& b) { return a.key == b.key; }),
              band_.end());
}

/// Calls visit(column, runs) with the layers to keep, ascending and apart, for every column that has any.
template <class Visit>
void ColumnScan::each_column(Visit&& visit) const {
  const std::int64_t layers = counts_[2];
  std::vector<Run> runs, joined;
  auto on = band_.begin();
  for (std::int64_t c = 0; c < columns_; ++c) {
    runs.clear();
    for (std::int64_t k = rows_[c]; k + 1 < rows_[c + 1]; k += 2) {
      Run run = range(2, heights_[k], heights_[k + 1]);
      while (run.first <= run.second && at(2, run.first) < heights_[k])
        ++run.first;
      while (run.first <= run.second && at(2, run.second) > heights_[k + 1])
        --run.second;
      if (run.first <= run.second)
        runs.push_back(run);
    }
    for (; on != band_.end() && on->key < (c + 1) * layers; ++on) {
      const auto layer = static_cast<std::int32_t>(on->key - c * layers);
      runs.emplace_back(layer, layer);
    }
    if (runs.empty())
      continue;
    std::sort(runs.begin(), runs.end());
    joined.clear();
    for (const Run& run : runs)
      if (!joined.empty() && run.first <= joined.back().second + 1)
        joined.back().second = std::max(joined.back().second, run.second);
      else
        joined.push_back(run);
    visit(c, joined);
  }
}

} // namespace tessera::preprocess
