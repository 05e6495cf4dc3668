#include "preprocess/seeding/poisson.hpp"

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "preprocess/seeding/voids.hpp"
#include "preprocess/voronoi/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tessera::preprocess {
namespace {

/// Longest edge of the parts searched for room, in radii: coarse ones first, which is where most points come
/// from; the last says how large a hole may stay.
constexpr std::array grains{1.7, 0.6, 0.22};
/// Of the simplices the search begins with.
constexpr double root_grain = 3;

/// A piece of the body, of one place on the CAD model.
struct Root {
  Simplex simplex; ///< its radii are the relative sizes
  CadPlace place;
};

/// The body's curves, surfaces and inside in pieces on which the size varies little.
class Pieces {
 public:
  Pieces(const TetBody& body, const SizeField& size, double radius)
      : body_(body), size_(size), radius_(radius) {}

  /// Those of CAD dimension d.
  std::vector<Root> of(int d) {
    roots_.clear();
    const Domain& domain = *body_.domain;
    const bool plane = domain.dimension == 2;
    const auto inside = [&] { return CadPlace{static_cast<std::uint8_t>(domain.dimension), -1}; };
    if (d == 1)
      for (const auto& edge : domain.feature_edges)
        add(1, {edge.vertices[0], edge.vertices[1], -1, -1}, {1, edge.curve});
    if (d == 2)
      for (const auto& facet : domain.facets) {
        const auto& [a, b, c] = facet.vertices;
        if (!plane)
          add(2, {a, b, c, -1}, {2, facet.surface});
        else if (facet.surface == Domain::lid && domain.vertices[a].z() > 0)
          add(2, {a, b, c, -1}, inside());
      }
    if (d == 3)
      for (const auto& tet : domain.tets)
        add(3, tet, inside());
    return std::move(roots_);
  }

 private:
  double size_at(const Vec3& x) const { return size_ ? size_(body_.scaling.out(x)) : 1; }

  void add(int d, const std::array<std::int32_t, 4>& vertices, const CadPlace& place) {
    Simplex simplex{d, {}, {}};
    for (int k = 0; k <= d; ++k) {
      simplex.corners[k] = body_.points[vertices[k]];
      if (body_.domain->dimension == 2)
        simplex.corners[k].z() = 0;
      simplex.radius[k] = size_at(simplex.corners[k]);
    }
    cut({simplex, place});
  }

  void cut(const Root& root) {
    const Simplex& s = root.simplex;
    const LongestEdge edge(s);
    const Vec3 middle = (s.corners[edge.a] + s.corners[edge.b]) / 2;
    const double there = size_at(middle);
    double least = there, most = there;
    for (int k = 0; k <= s.dimension; ++k) {
      least = std::min(least, s.radius[k]);
      most = std::max(most, s.radius[k]);
    }
    const double length = std::sqrt(edge.squared);
    if (length <= root_grain * radius_ * least && (most <= 1.5 * least || length <= 0.2 * radius_ * least)) {
      roots_.push_back(root);
      return;
    }
    for (const int replaced : {edge.a, edge.b}) {
      Root half = root;
      half.simplex.corners[replaced] = middle;
      half.simplex.radius[replaced] = there;
      cut(half);
    }
  }

  const TetBody& body_;
  const SizeField& size_;
  double radius_;
  std::vector<Root> roots_;
};

/// Fills a body with points that keep one radius (times size).
class Filling {
 public:
  Filling(const TetBody& body, const CadTopology& cad, const PoissonRequest& request, double radius)
      : body_(body), cad_(cad), request_(request), radius_(radius), dimension_(body.domain->dimension) {}

  PlacedPoints points() {
    Pieces pieces(body_, request_.size, radius_);
    std::vector<Root> roots = pieces.of(dimension_);
    double least = 1, most = 0;
    for (const Root& root : roots)
      for (int k = 0; k <= dimension_; ++k) {
        least = std::min(least, root.simplex.radius[k]);
        most = std::max(most, root.simplex.radius[k]);
      }
    KeptPoints kept(cad_, dimension_, radius_ * least, radius_ * most);
    for (const std::int32_t v : body_.domain->corners) {
      Vec3 x = body_.points[v];
      if (dimension_ == 2)
        x.z() = 0;
      kept.add(x, {0, v});
    }
    for (int d = 1; d < dimension_; ++d)
      fill(pieces.of(d), kept);
    fill(std::move(roots), kept);
    return kept.take();
  }

 private:
  static constexpr std::int64_t block = 64;

  void fill(std::vector<Root> roots, KeptPoints& kept) {
    for (Root& root : roots)
      for (double& r : root.simplex.radius)
        r *= radius_;
    for (const double grain : grains) {
      const auto found = search(roots, kept, grain);
      stop_if_interrupted("filling with particles");
      insert(roots, found, kept);
    }
  }

  /// Room in each root, were all the rest to stay as it is.
  std::vector<std::vector<std::pair<Vec3, std::int32_t>>> search(const std::vector<Root>& roots,
                                                                 const KeptPoints& kept, double grain) const {
    const auto count = static_cast<std::int64_t>(roots.size());
    std::vector<std::vector<std::pair<Vec3, std::int32_t>>> found((count + block - 1) / block);
    for_each_uneven(static_cast<std::int64_t>(found.size()), [&](std::int64_t b) {
      VoidSearch voids(grain);
      std::vector<std::int32_t> near;
      std::vector<Claimed> claims;
      std::vector<Vec3> points;
      for (std::int64_t i = b * block; i < std::min(count, (b + 1) * block); ++i) {
        const auto& [simplex, place] = roots[i];
        const Vec3& x = simplex.corners[0];
        const double most =
            *std::max_element(simplex.radius.begin(), simplex.radius.begin() + simplex.dimension + 1);
        near.clear();
        kept.collect(x, most + std::sqrt(LongestEdge(simplex).squared), near);
        claims.clear();
        for (const std::int32_t k : near)
          if (const double c = claim(cad_, dimension_, kept.points().place[k], place); c > 0)
            claims.push_back({kept.points().X[k], c});
        points.clear();
        voids.run(simplex, claims, key(grain, simplex.dimension, i), points);
        for (const Vec3& p : points)
          found[b].emplace_back(p, static_cast<std::int32_t>(i));
      }
    });
    return found;
  }

  std::uint64_t key(double grain, int d, std::int64_t root) const {
    std::uint64_t h = request_.seed;
    for (const auto part : {static_cast<std::uint64_t>(100 * grain), static_cast<std::uint64_t>(d),
                            static_cast<std::uint64_t>(root)})
      h = (h ^ part) * 0xD1342543DE82EF95u + 0x9E3779B97F4A7C15u;
    return h ^ (h >> 32);
  }

  /// Passes over the points found, each taking a random part of them: as good as a random order, but near
  /// points are looked at one after the other.
  void insert(const std::vector<Root>& roots,
              const std::vector<std::vector<std::pair<Vec3, std::int32_t>>>& found, KeptPoints& kept) const {
    constexpr std::uint64_t passes = 8;
    for (std::uint64_t pass = 0; pass < passes; ++pass) {
      std::uint64_t number = request_.seed;
      for (const auto& some : found)
        for (const auto& [x, root] : some) {
          number += 0x9E3779B97F4A7C15u;
          if (((number ^ (number >> 31)) * 0xBF58476D1CE4E5B9u) >> 61 != pass)
            continue;
          const CadPlace& place = roots[root].place;
          const double radius = request_.size ? radius_ * request_.size(body_.scaling.out(x)) : radius_;
          if (kept.has_room(x, place, radius))
            kept.add(x, place);
        }
    }
  }

  const TetBody& body_;
  const CadTopology& cad_;
  const PoissonRequest& request_;
  double radius_; ///< scaled
  int dimension_;
};

} // namespace

PoissonCloud poisson_points(const TetBody& body, const CadTopology& cad, const PoissonRequest& request,
                            Progress& progress) {
  constexpr int most_tries = 12;
  const int dimension = body.domain->dimension;
  const auto wanted = static_cast<double>(request.count);
  progress.begin("filling with particles", most_tries);
  PoissonCloud best;
  double best_error = std::numeric_limits<double>::infinity();
  double radius = 0.85 * std::pow(graded_volume(*body.domain, request.size) / wanted, 1. / dimension);
  for (int t = 0; t < most_tries && best_error > 0.02; ++t) {
    PoissonCloud next{Filling(body, cad, request, radius / body.scaling.length).points(), radius};
    const auto got = static_cast<double>(next.points.size());
    progress.advance(t + 1, fmt::format("radius {:.3g} m, {} particles", radius, next.points.size()));
    radius *= std::pow(got / wanted, 1. / dimension);
    if (const double error = std::abs(got - wanted) / wanted; error < best_error) {
      best = std::move(next);
      best_error = error;
    }
  }
  progress.finish(fmt::format("radius {:.3g} m, {} particles", best.radius, best.points.size()));
  return best;
}

} // namespace tessera::preprocess
