#include "preprocess/seeding/poisson.hpp"

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "preprocess/seeding/voids.hpp"
#include "preprocess/voronoi/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace tessera::preprocess {
namespace {

/// How far across the parts are that are searched for room, in radii: coarse ones first, which is where most
/// points come from; the last says how large a hole may stay.
constexpr std::array grains{1.7, 0.8, 0.45, 0.3};
/// Of the simplices and the side of the cubes the search begins with.
constexpr double root_grain = 2;

/// A piece of a curve, a surface or the inside of a plane body.
struct Root {
  Simplex simplex; ///< its radii are the relative sizes
  CadPlace place;
};

/// The body's curves and surfaces, or a plane body's inside, in pieces on which the size varies little.
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

/// Points found, each with the place it would have.
using Found = std::vector<std::vector<std::pair<Vec3, CadPlace>>>;

/// Fills a body with points that keep one radius (times size).
class Filling {
 public:
  /// `boxes` only for a body in space.
  Filling(const TetBody& body, const CadTopology& cad, const PoissonRequest& request, const BodyBoxes* boxes,
          double radius)
      : body_(body), cad_(cad), request_(request), boxes_(boxes), radius_(radius),
        dimension_(body.domain->dimension) {}

  PlacedPoints points() {
    Pieces pieces(body_, request_.size, radius_);
    double least = 1, most = 0;
    const auto widen = [&](double size) {
      least = std::min(least, size);
      most = std::max(most, size);
    };
    std::vector<Root> roots;
    std::vector<Cube> cubes;
    std::vector<double> sizes; // of the cubes
    if (dimension_ == 3) {
      cubes = boxes_->cover([&](const Cube& cube) { return root_grain * radius_ * least_size(cube); });
      sizes.resize(cubes.size());
      for_each(static_cast<std::int64_t>(cubes.size()),
               [&](std::int64_t i) { sizes[i] = least_size(cubes[i]); });
      std::for_each(sizes.begin(), sizes.end(), widen);
    } else {
      roots = pieces.of(2);
      for (const Root& root : roots)
        std::for_each_n(root.simplex.radius.begin(), 3, widen);
    }
    KeptPoints kept(cad_, dimension_, radius_ * least, radius_ * most);
    for (const std::int32_t v : body_.domain->corners) {
      Vec3 x = body_.points[v];
      if (dimension_ == 2)
        x.z() = 0;
      kept.add(x, {0, v});
    }
    fill(pieces.of(1), kept);
    fill(dimension_ == 2 ? std::move(roots) : pieces.of(2), kept);
    for (const double grain : grains)
      if (dimension_ == 3)
        insert(search(cubes, sizes, kept, grain), kept);
    return kept.take();
  }

 private:
  static constexpr std::int64_t block = 64;

  double least_size(const Cube& cube) const {
    if (!request_.size)
      return 1;
    double least = request_.size(body_.scaling.out(cube.middle));
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 to(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      least = std::min(least, request_.size(body_.scaling.out(cube.middle + cube.half * to)));
    }
    return least;
  }

  void fill(std::vector<Root> roots, KeptPoints& kept) const {
    for (Root& root : roots)
      for (double& r : root.simplex.radius)
        r *= radius_;
    for (const double grain : grains)
      insert(search(roots, kept, grain), kept);
  }

  /// Room in each of `count` pieces, were all the rest to stay as it is: visit(i, near, claims, voids,
  /// points).
  template <class Visit>
  static Found search_blocks(std::int64_t count, double grain, Visit&& visit) {
    Found found((count + block - 1) / block);
    for_each_uneven(static_cast<std::int64_t>(found.size()), [&](std::int64_t b) {
      VoidSearch voids(grain);
      std::vector<std::int32_t> near;
      std::vector<Claimed> claims;
      std::vector<Vec3> points;
      for (std::int64_t i = b * block; i < std::min(count, (b + 1) * block); ++i) {
        near.clear();
        claims.clear();
        points.clear();
        const CadPlace place = visit(i, near, claims, voids, points);
        for (const Vec3& p : points)
          found[b].emplace_back(p, place);
      }
    });
    stop_if_interrupted("filling with particles");
    return found;
  }

  Found search(const std::vector<Root>& roots, const KeptPoints& kept, double grain) const {
    return search_blocks(
        static_cast<std::int64_t>(roots.size()), grain,
        [&](std::int64_t i, auto& near, auto& claims, VoidSearch& voids, auto& points) {
          const auto& [simplex, place] = roots[i];
          const double most =
              *std::max_element(simplex.radius.begin(), simplex.radius.begin() + simplex.dimension + 1);
          kept.collect(simplex.corners[0], most + std::sqrt(LongestEdge(simplex).squared), near);
          for (const std::int32_t k : near)
            if (const double c = claim(cad_, dimension_, kept.points().place[k], place); c > 0)
              claims.push_back({kept.points().X[k], c});
          voids.run(simplex, claims, key(grain, simplex.dimension, i), points);
          return place;
        });
  }

  Found search(const std::vector<Cube>& cubes, const std::vector<double>& sizes, const KeptPoints& kept,
               double grain) const {
    return search_blocks(static_cast<std::int64_t>(cubes.size()), grain,
                         [&](std::int64_t i, auto& near, auto& claims, VoidSearch& voids, auto& points) {
                           const double radius = radius_ * sizes[i];
                           kept.collect(cubes[i].middle, radius + std::sqrt(3.) * cubes[i].half, near);
                           for (const std::int32_t k : near)
                             claims.push_back({kept.points().X[k], 1});
                           voids.run(cubes[i], radius, *boxes_, claims, key(grain, 3, i), points);
                           return CadPlace{};
                         });
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
  void insert(const Found& found, KeptPoints& kept) const {
    constexpr std::uint64_t passes = 8;
    for (std::uint64_t pass = 0; pass < passes; ++pass) {
      std::uint64_t number = request_.seed;
      for (const auto& some : found)
        for (const auto& [x, place] : some) {
          number += 0x9E3779B97F4A7C15u;
          if (((number ^ (number >> 31)) * 0xBF58476D1CE4E5B9u) >> 61 != pass)
            continue;
          const double radius = request_.size ? radius_ * request_.size(body_.scaling.out(x)) : radius_;
          if (kept.has_room(x, place, radius))
            kept.add(x, place);
        }
    }
  }

  const TetBody& body_;
  const CadTopology& cad_;
  const PoissonRequest& request_;
  const BodyBoxes* boxes_;
  double radius_; ///< scaled
  int dimension_;
};

/// About how many particles fill a body for a radius: what each dimension takes beside those before it,
/// measured on blocks of a thousand to a million particles.
class Expected {
 public:
  Expected(const TetBody& body, const SizeField& size) : dimension_(body.domain->dimension) {
    const Domain& domain = *body.domain;
    const auto mean = [&](std::initializer_list<std::int32_t> vertices, int power) {
      double total = 0;
      for (const std::int32_t v : vertices)
        total += size ? std::pow(size(domain.vertices[v]), -power) : 1;
      return total / static_cast<double>(vertices.size());
    };
    inside_ = graded_volume(domain, size);
    for (const auto& edge : domain.feature_edges) {
      const auto [a, b] = edge.vertices;
      along_curves_ += (domain.vertices[b] - domain.vertices[a]).norm() * mean({a, b}, 1);
    }
    for (const auto& facet : domain.facets) {
      const auto [a, b, c] = facet.vertices;
      const Vec3 &A = domain.vertices[a], &B = domain.vertices[b], &C = domain.vertices[c];
      on_surfaces_ += dimension_ == 3 ? (B - A).cross(C - A).norm() / 2 * mean({a, b, c}, 2) : 0;
    }
  }

  double particles(double radius) const {
    return dimension_ == 2 ? 0.68 * inside_ / (radius * radius) + 0.37 * along_curves_ / radius
                           : 0.70 * inside_ / std::pow(radius, 3) + 0.29 * on_surfaces_ / (radius * radius) +
                                 0.3 * along_curves_ / radius;
  }

  /// The radius (m) for which that many are expected.
  double radius(double particles_wanted) const {
    double low = 0, high = 2 * std::pow(inside_ / particles_wanted, 1. / dimension_) + along_curves_;
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      (particles(middle) > particles_wanted ? low : high) = middle;
    }
    return high;
  }

 private:
  int dimension_;
  double inside_ = 0, on_surfaces_ = 0, along_curves_ = 0; ///< integrals of size^-k, m^k
};

} // namespace

PoissonCloud poisson_points(const TetBody& body, const CadTopology& cad, const PoissonRequest& request,
                            Progress& progress) {
  constexpr int most_tries = 12;
  const int dimension = body.domain->dimension;
  const auto wanted = static_cast<double>(request.count);
  progress.begin("filling with particles", most_tries);
  std::optional<BodyBoxes> boxes;
  if (dimension == 3)
    boxes.emplace(body);
  PoissonCloud best;
  double best_error = std::numeric_limits<double>::infinity();
  const Expected expected(body, request.size);
  double radius = expected.radius(wanted);
  for (int t = 0; t < most_tries && best_error > 0.02; ++t) {
    PoissonCloud next{
        Filling(body, cad, request, boxes ? &*boxes : nullptr, radius / body.scaling.length).points(),
        radius};
    const auto got = static_cast<double>(next.points.size());
    progress.advance(t + 1, fmt::format("radius {:.3g} m, {} particles", radius, next.points.size()));
    radius = expected.radius(wanted * expected.particles(radius) / got);
    if (const double error = std::abs(got - wanted) / wanted; error < best_error) {
      best = std::move(next);
      best_error = error;
    }
  }
  progress.finish(fmt::format("radius {:.3g} m, {} particles", best.radius, best.points.size()));
  return best;
}

} // namespace tessera::preprocess
