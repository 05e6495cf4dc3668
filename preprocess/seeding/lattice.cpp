#include "preprocess/seeding/lattice.hpp"

#include "preprocess/seeding/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tessera::preprocess {
namespace {

/// A lattice point on the boundary, by its place in the scan: column * layers + layer.
struct OnBoundary {
  std::int64_t key;
  CadPlace place;
};

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).squaredNorm();
}

double squared_distance_to_triangle(const Vec3& p, const std::array<Vec3, 3>& X, const Vec3& normal) {
  bool above = true;
  for (int k = 0; k < 3; ++k)
    above &= normal.dot((X[(k + 1) % 3] - X[k]).cross(p - X[k])) >= 0;
  if (above)
    return std::pow(normal.dot(p - X[0]), 2);
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    nearest = std::min(nearest, squared_distance_to_segment(p, X[k], X[(k + 1) % 3]));
  return nearest;
}

/// The columns of a lattice: where each enters and leaves the body, and the points of the boundary's band.
class ColumnScan {
 public:
  ColumnScan(const Domain& domain, const CadTopology& cad, const Lattice& frame)
      : domain_(domain), cad_(cad), frame_(frame), columns_(std::int64_t{frame.counts[0]} * frame.counts[1]) {
    normals_.reserve(domain.facets.size());
    for (const auto& facet : domain.facets) {
      const auto X = corners(facet);
      normals_.push_back((X[1] - X[0]).cross(X[2] - X[0]).normalized());
    }
    for (std::size_t f = 0; f < domain.facets.size(); ++f) {
      cross(corners(domain.facets[f]));
      mark_band(static_cast<std::int32_t>(f));
    }
    sort_crossings();
    sort_band();
  }

  std::int64_t count() const {
    std::int64_t total = 0;
    each_column([&](std::int64_t, const std::vector<Run>& runs) {
      for (const auto& [first, last] : runs)
        total += last - first + 1;
    });
    return total;
  }

  void emit(Lattice& lattice) const {
    const std::int64_t total = count();
    lattice.index.reserve(total);
    lattice.place.assign(total, CadPlace{});
    auto on = band_.begin();
    each_column([&](std::int64_t column, const std::vector<Run>& runs) {
      const auto i = static_cast<std::int32_t>(column / frame_.counts[1]);
      const auto j = static_cast<std::int32_t>(column % frame_.counts[1]);
      for (const auto& [first, last] : runs) {
        const auto base = static_cast<std::int64_t>(lattice.index.size()) - first;
        for (std::int32_t k = first; k <= last; ++k)
          lattice.index.push_back({i, j, k});
        for (; on != band_.end() && on->key <= column * frame_.counts[2] + last; ++on)
          lattice.place[base + on->key % frame_.counts[2]] = on->place;
      }
    });
  }

 private:
  using Run = std::pair<std::int32_t, std::int32_t>; ///< first and last layer

  std::array<Vec3, 3> corners(const Domain::Facet& facet) const {
    return {domain_.vertices[facet.vertices[0]], domain_.vertices[facet.vertices[1]],
            domain_.vertices[facet.vertices[2]]};
  }
  double at(int axis, std::int64_t i) const {
    return frame_.origin[axis] + frame_.spacing * static_cast<double>(i);
  }
  /// Lattice indices along an axis that may lie in [low, high], one more on either side.
  Run range(int axis, double low, double high) const {
    const auto index = [&](double x) {
      return std::clamp((x - frame_.origin[axis]) / frame_.spacing, -2.0, frame_.counts[axis] + 1.0);
    };
    return {std::max(0, static_cast<std::int32_t>(std::floor(index(low)))),
            std::min(frame_.counts[axis] - 1, static_cast<std::int32_t>(std::ceil(index(high))))};
  }

  /// Adds the heights at which columns cross a triangle.
  void cross(const std::array<Vec3, 3>& X) {
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
            orientation_perturbed(p[1], p[2], here) != turn ||
            orientation_perturbed(p[2], p[0], here) != turn)
          continue;
        const double z =
            X[0].z() - (normal.x() * (here.x - p[0].x) + normal.y() * (here.y - p[0].y)) / normal.z();
        crossings_.push_back({std::int64_t{i} * frame_.counts[1] + j, std::clamp(z, z_low, z_high)});
      }
    }
  }

  /// How far the curved face can bulge over a facet: a chord c that turns by the angle t has the height c/2
  /// tan(t/4).
  double chordal_error(std::int32_t f) const {
    const auto X = corners(domain_.facets[f]);
    double error = 0;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t g = cad_.smooth_across(f)[k];
      if (g < 0)
        continue;
      const double turn = std::acos(std::clamp(normals_[f].dot(normals_[g]), -1.0, 1.0));
      const Vec3 side = (X[(k + 1) % 3] - X[k]).normalized();
      const Vec3 apex = X[(k + 2) % 3] - X[k];
      error = std::max(error, (apex - apex.dot(side) * side).norm() / 2 * std::tan(turn / 4));
    }
    return error;
  }

  /// Marks the lattice points within the band of a facet.
  void mark_band(std::int32_t f) {
    const auto X = corners(domain_.facets[f]);
    const Vec3& normal = normals_[f];
    const double band = std::clamp(chordal_error(f), lattice_band * frame_.spacing, 0.25 * frame_.spacing);
    // Look along the axis the facet faces most: on each line at most a point or two lie near its plane.
    int w;
    normal.cwiseAbs().maxCoeff(&w);
    const int u = (w + 1) % 3, v = (w + 2) % 3;
    const auto extent = [&](int axis) {
      const auto [low, high] = std::minmax({X[0][axis], X[1][axis], X[2][axis]});
      return range(axis, low - band, high + band);
    };
    const Run us = extent(u), vs = extent(v);
    std::array<std::int32_t, 3> index{};
    for (index[u] = us.first; index[u] <= us.second; ++index[u])
      for (index[v] = vs.first; index[v] <= vs.second; ++index[v]) {
        const double plane =
            X[0][w] -
            (normal[u] * (at(u, index[u]) - X[0][u]) + normal[v] * (at(v, index[v]) - X[0][v])) / normal[w];
        const double reach = band / std::abs(normal[w]);
        const Run ws = range(w, plane - reach, plane + reach);
        for (index[w] = ws.first; index[w] <= ws.second; ++index[w]) {
          const Vec3 p(at(0, index[0]), at(1, index[1]), at(2, index[2]));
          if (std::abs(p[w] - plane) > reach || squared_distance_to_triangle(p, X, normal) > band * band)
            continue;
          const std::int64_t column = std::int64_t{index[0]} * frame_.counts[1] + index[1];
          band_.push_back({column * frame_.counts[2] + index[2], place(p, f, X, band)});
        }
      }
  }

  CadPlace place(const Vec3& p, std::int32_t f, const std::array<Vec3, 3>& X, double band) const {
    const auto& facet = domain_.facets[f];
    for (int k = 0; k < 3; ++k)
      if (cad_.is_corner(facet.vertices[k]) && (p - X[k]).squaredNorm() <= band * band)
        return {0, facet.vertices[k]};
    for (int k = 0; k < 3; ++k)
      if (const std::int32_t curve = cad_.curves_around(f)[k];
          curve >= 0 && squared_distance_to_segment(p, X[k], X[(k + 1) % 3]) <= band * band)
        return {1, curve};
    return {2, facet.surface};
  }

  void sort_crossings() {
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
  void sort_band() {
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
  void each_column(Visit&& visit) const {
    const std::int64_t layers = frame_.counts[2];
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

  const Domain& domain_;
  const CadTopology& cad_;
  const Lattice& frame_;
  std::int64_t columns_;
  std::vector<Vec3> normals_;
  std::vector<std::pair<std::int64_t, double>> crossings_; ///< column, height
  std::vector<std::int64_t> rows_;
  std::vector<double> heights_;
  std::vector<OnBoundary> band_;
};

} // namespace

Lattice lattice_frame(const Domain& domain, double spacing) {
  Lattice frame;
  frame.spacing = spacing;
  for (int a = 0; a < 3; ++a) {
    const double length = domain.upper[a] - domain.lower[a];
    // A face that falls short of a whole spacing by less than the band still gets its layer.
    const double intervals = std::floor(length / spacing + lattice_band);
    frame.counts[a] = static_cast<std::int32_t>(intervals) + 1;
    frame.origin[a] = (domain.lower[a] + domain.upper[a] - intervals * spacing) / 2;
  }
  return frame;
}

Lattice lattice_points(const Domain& domain, const CadTopology& cad, double spacing) {
  Lattice lattice = lattice_frame(domain, spacing);
  const Lattice frame = lattice;
  ColumnScan(domain, cad, frame).emit(lattice);
  return lattice;
}

std::int64_t lattice_count(const Domain& domain, const CadTopology& cad, double spacing) {
  const Lattice frame = lattice_frame(domain, spacing);
  return ColumnScan(domain, cad, frame).count();
}

double lattice_spacing_for(const Domain& domain, const CadTopology& cad, std::int64_t count) {
  const auto wanted = static_cast<double>(count);
  const Vec3 sides = domain.upper - domain.lower;
  double best = 0, best_error = std::numeric_limits<double>::infinity();
  const auto try_spacing = [&](double spacing) {
    const auto points = static_cast<double>(lattice_count(domain, cad, spacing));
    const double error = std::abs(points - wanted) / wanted;
    if (error < best_error) {
      best = spacing;
      best_error = error;
    }
    return points;
  };
  // Fewer points on wider lattices, on the whole: bisection, then the spacings nearby that divide a side.
  double fine = std::cbrt(domain.volume / wanted) / 2;
  double coarse = std::max(8 * fine, 2 * sides.maxCoeff());
  for (int step = 0; step < 40 && coarse / fine > 1 + 1e-4; ++step) {
    const double middle = std::sqrt(fine * coarse);
    (try_spacing(middle) > wanted ? fine : coarse) = middle;
  }
  const double near = std::sqrt(fine * coarse);
  double divisor = 0, divisor_error = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (double n = std::floor(sides[axis] / near) - 1; n <= std::ceil(sides[axis] / near) + 1; ++n) {
      if (n < 1)
        continue;
      const double points = try_spacing(sides[axis] / n);
      const double error = std::abs(points - wanted) / wanted;
      if (error < divisor_error) {
        divisor = sides[axis] / n;
        divisor_error = error;
      }
    }
  // A lattice with points on the faces is worth a slightly worse count where neither is within 2 %.
  const double allowed = best_error <= 0.02 ? 0.02 : 2 * best_error;
  return divisor > 0 && divisor_error <= allowed ? divisor : best;
}

} // namespace tessera::preprocess
