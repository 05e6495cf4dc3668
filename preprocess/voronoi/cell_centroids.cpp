#include "preprocess/voronoi/cell_centroids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tessera::preprocess {
namespace {

/// How far a point lies outside a tetrahedron: the largest signed distance from its four planes.
double distance_outside(const TetBody& body, std::int32_t t, const Vec3& x) {
  const auto& tet = body.domain->tets[t];
  double most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k) {
    const Vec3 &apex = body.points[tet[k]], &a = body.points[tet[(k + 1) % 4]];
    Vec3 normal = (body.points[tet[(k + 2) % 4]] - a).cross(body.points[tet[(k + 3) % 4]] - a).normalized();
    if (normal.dot(apex - a) > 0)
      normal = -normal;
    most = std::max(most, normal.dot(x - a));
  }
  return most;
}

} // namespace

/// size^-power near a point, relative to the one there: the size by its slope, never below a third.
class CellCentroids::Weight {
 public:
  Weight(const SizeField& size, const RestrictedVoronoi& voronoi, std::int64_t i, int power) : power_(power) {
    if (!size)
      return;
    const TetBody& body = voronoi.body();
    const Vec3& x = voronoi.seeds()[i];
    const auto neighbours = voronoi.graph().of(i);
    const double step = neighbours.empty() ? 0.5 : (voronoi.seeds()[neighbours[0]] - x).norm() / 2;
    const double here = size(body.scaling.out(x));
    for (int a = 0; a < body.domain->dimension; ++a) {
      const Vec3 aside = step * Vec3::Unit(a);
      slope_[a] = (size(body.scaling.out(x + aside)) - size(body.scaling.out(x - aside))) / (2 * step * here);
    }
    even_ = slope_.isZero(0);
  }
  bool even() const { return even_; }
  double operator()(const Vec3& from_point) const {
    const double size = std::max(1. / 3, 1 + slope_.dot(from_point));
    double power = size;
    for (int k = 1; k < power_; ++k)
      power *= size;
    return 1 / power;
  }

 private:
  int power_;
  bool even_ = true;
  Vec3 slope_ = Vec3::Zero();
};

template <class Add>
CellCentroids::Sum CellCentroids::sum_over_own_part(std::int64_t i, Add&& add) const {
  struct Part {
    Sum sum;
    double from_point = std::numeric_limits<double>::infinity();
  };
  Sum first;
  bool several = false;
  voronoi_.visit(i, [&](const CellPiece& piece) {
    if (piece.component == 0)
      add(piece, first);
    else
      several = true;
  });
  if (!several)
    return first;
  std::vector<Part> parts;
  voronoi_.visit(i, [&](const CellPiece& piece) {
    parts.resize(std::max<std::size_t>(parts.size(), piece.component + 1));
    Part& part = parts[piece.component];
    add(piece, part.sum);
    part.from_point =
        std::min(part.from_point, distance_outside(voronoi_.body(), piece.tet, voronoi_.seeds()[i]));
  });
  return std::min_element(parts.begin(), parts.end(),
                          [](const Part& a, const Part& b) { return a.from_point < b.from_point; })
      ->sum;
}

Vec3 CellCentroids::of_cell(std::int64_t i) const {
  const int dimension = voronoi_.body().domain->dimension;
  const Vec3& x = voronoi_.seeds()[i];
  const Weight weight(size_, voronoi_, i, dimension + 2);
  const Sum sum = sum_over_own_part(i, [&](const CellPiece& piece, Sum& total) {
    if (weight.even()) {
      const auto measure = piece.cell.measure(x);
      total.weight += measure.volume;
      total.moment += measure.moment;
      return;
    }
    // Tetrahedra from a point inside the piece, all positive, the weight of each taken at its middle.
    const auto vertices = piece.cell.vertices();
    Vec3 inside = Vec3::Zero();
    for (const Vec3& v : vertices)
      inside += v / static_cast<double>(vertices.size());
    for (const auto& face : piece.cell.faces()) {
      const auto loop = piece.cell.loop(face);
      const Vec3 a = vertices[loop[0]] - inside;
      for (std::size_t k = 2; k < loop.size(); ++k) {
        const Vec3 b = vertices[loop[k - 1]] - inside, c = vertices[loop[k]] - inside;
        const Vec3 middle = inside - x + (a + b + c) / 4;
        const double w = a.dot(b.cross(c)) / 6 * weight(middle);
        total.weight += w;
        total.moment += w * middle;
      }
    }
  });
  return sum.weight > 0 ? Vec3(x + sum.moment / sum.weight) : x;
}

std::optional<Vec3> CellCentroids::of_surface(std::int64_t i, std::int32_t surface) const {
  const Vec3& x = voronoi_.seeds()[i];
  const Weight weight(size_, voronoi_, i, 4);
  const Sum sum = sum_over_own_part(i, [&](const CellPiece& piece, Sum& total) {
    for (const auto& face : piece.cell.faces()) {
      const std::int32_t facet = voronoi_.facet_of(piece, face);
      if (facet < 0 || voronoi_.body().domain->facets[facet].surface != surface)
        continue;
      const auto loop = piece.cell.loop(face);
      const auto vertices = piece.cell.vertices();
      const Vec3 a = vertices[loop[0]] - x;
      for (std::size_t k = 2; k < loop.size(); ++k) {
        const Vec3 b = vertices[loop[k - 1]] - x, c = vertices[loop[k]] - x;
        const Vec3 middle = (a + b + c) / 3;
        const double w = (b - a).cross(c - a).norm() / 2 * weight(middle);
        total.weight += w;
        total.moment += w * middle;
      }
    }
  });
  if (!(sum.weight > 0))
    return {};
  return x + sum.moment / sum.weight;
}

} // namespace tessera::preprocess
