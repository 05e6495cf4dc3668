#include "preprocess/voronoi/curve_chains.hpp"

#include "preprocess/seeding/nearness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace tessera::preprocess {
namespace {

Vec3 place_of(const TetBody& body, std::int32_t vertex) {
  const Vec3& x = body.points[vertex];
  return body.domain->dimension == 2 ? Vec3(x.x(), x.y(), 0) : x;
}

/// The edges of one curve by the vertices they meet at.
struct Mesh {
  std::vector<std::array<std::int32_t, 2>> edges;
  std::map<std::int32_t, std::vector<std::int32_t>> around;
  std::vector<bool> used;

  void add(const std::array<std::int32_t, 2>& edge) {
    for (const std::int32_t v : edge)
      around[v].push_back(static_cast<std::int32_t>(edges.size()));
    edges.push_back(edge);
    used.push_back(false);
  }

  /// Vertices from `start` along unused edges up to where `ends` holds or the way comes back.
  template <class Ends>
  std::vector<std::int32_t> follow(std::int32_t start, std::int32_t edge, Ends&& ends) {
    std::vector<std::int32_t> way{start};
    while (edge >= 0) {
      used[edge] = true;
      way.push_back(edges[edge][0] == way.back() ? edges[edge][1] : edges[edge][0]);
      edge = -1;
      if (ends(way.back()))
        break;
      for (const std::int32_t next : around[way.back()])
        if (!used[next])
          edge = next;
    }
    return way;
  }
};

} // namespace

CurveChains::CurveChains(const TetBody& body, const CadTopology& cad, const SizeField& size) {
  std::map<std::int32_t, Mesh> curves;
  for (const auto& edge : body.domain->feature_edges)
    curves[edge.curve].add(edge.vertices);
  for (auto& [curve, mesh] : curves) {
    const auto ends = [&, &around = mesh.around](std::int32_t v) {
      return cad.is_corner(v) || around.at(v).size() != 2;
    };
    for (const auto& [v, edges] : mesh.around)
      if (ends(v))
        for (const std::int32_t e : edges)
          if (!mesh.used[e])
            add_chain(body, cad, size, curve, mesh.follow(v, e, ends));
    for (std::size_t e = 0; e < mesh.edges.size(); ++e)
      if (!mesh.used[e])
        add_chain(body, cad, size, curve, mesh.follow(mesh.edges[e][0], static_cast<std::int32_t>(e), ends));
  }
}

void CurveChains::add_chain(const TetBody& body, const CadTopology& cad, const SizeField& size,
                            std::int32_t curve, const std::vector<std::int32_t>& vertices) {
  Chain chain;
  chain.curve = curve;
  chain.starts_at_corner = cad.is_corner(vertices.front());
  chain.ends_at_corner = cad.is_corner(vertices.back());
  chain.closed = vertices.front() == vertices.back() && !chain.starts_at_corner;
  chain.points.push_back(place_of(body, vertices.front()));
  chain.length_up_to.push_back(0);
  for (std::size_t k = 1; k < vertices.size(); ++k) {
    const Vec3 begin = place_of(body, vertices[k - 1]), end = place_of(body, vertices[k]);
    // Where sizes vary a step is short against the spacing, which is about 1.
    const int steps = size ? static_cast<int>(std::ceil(8 * (end - begin).norm())) : 1;
    for (int s = 1; s <= steps; ++s) {
      const Vec3 next = s == steps ? end : Vec3(begin + (end - begin) * s / steps);
      const double length = (next - chain.points.back()).norm();
      const double relative = size ? size(body.scaling.out((next + chain.points.back()) / 2)) : 1;
      chain.length_up_to.push_back(chain.length_up_to.back() + length / relative);
      chain.points.push_back(next);
    }
  }
  if (static_cast<std::size_t>(curve) >= chains_of_.size())
    chains_of_.resize(curve + 1);
  chains_of_[curve].push_back(static_cast<std::int32_t>(chains_.size()));
  chains_.push_back(std::move(chain));
}

CurveChains::Found CurveChains::find(const Vec3& x, std::int32_t curve) const {
  Found best{-1, 0};
  double distance = std::numeric_limits<double>::infinity();
  for (const std::int32_t c : chains_of_[curve]) {
    const Chain& chain = chains_[c];
    for (std::size_t k = 1; k < chain.points.size(); ++k) {
      const Vec3 &a = chain.points[k - 1], &b = chain.points[k];
      const Vec3 nearest = nearest_on_segment(x, a, b);
      const double d = (x - nearest).squaredNorm();
      if (!(d < distance))
        continue;
      distance = d;
      const double whole = (b - a).norm(), part = whole > 0 ? (nearest - a).norm() / whole : 0;
      best = {c, chain.length_up_to[k - 1] + part * (chain.length_up_to[k] - chain.length_up_to[k - 1])};
    }
  }
  return best;
}

Vec3 CurveChains::point_at(const Chain& chain, double length) {
  const auto& up_to = chain.length_up_to;
  const auto at = std::upper_bound(up_to.begin() + 1, up_to.end() - 1, length) - up_to.begin();
  const double t = (length - up_to[at - 1]) / (up_to[at] - up_to[at - 1]);
  return chain.points[at - 1] + t * (chain.points[at] - chain.points[at - 1]);
}

void CurveChains::spread(PlacedPoints& particles) const {
  std::vector<std::vector<std::pair<double, std::int64_t>>> on(chains_.size()); // length, particle
  for (std::int64_t i = 0; i < particles.size(); ++i)
    if (particles.place[i].dimension == 1) {
      const Found found = find(particles.X[i], particles.place[i].entity);
      on[found.chain].emplace_back(found.at, i);
    }
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    const Chain& chain = chains_[c];
    std::sort(on[c].begin(), on[c].end());
    const double whole = chain.length_up_to.back(), n = static_cast<double>(on[c].size());
    // A particle owns half the way to the next one, or all of it up to an end that is no corner.
    const double before = chain.starts_at_corner ? 1 : 0.5, after = chain.ends_at_corner ? 1 : 0.5;
    const double step = whole / (chain.closed ? n : n - 1 + before + after);
    double start = before * step;
    if (chain.closed) { // turned so that particles move as little as they can
      start = 0;
      for (std::size_t k = 0; k < on[c].size(); ++k)
        start += (on[c][k].first - static_cast<double>(k) * step) / n;
    }
    for (std::size_t k = 0; k < on[c].size(); ++k) {
      double at = start + static_cast<double>(k) * step;
      if (chain.closed)
        at -= whole * std::floor(at / whole);
      particles.X[on[c][k].second] = point_at(chain, at);
    }
  }
}

} // namespace tessera::preprocess
