#include "preprocess/geometry/features.hpp"

#include "preprocess/geometry/triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace tessera::preprocess {
namespace {

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

Vec3 area_vector(const Domain& domain, const Domain::Facet& facet) {
  const Vec3& A = domain.vertices[facet.vertices[0]];
  return (domain.vertices[facet.vertices[1]] - A).cross(domain.vertices[facet.vertices[2]] - A) / 2;
}

struct Meeting {
  Edge edge;
  std::int32_t facet;
};

/// Facets along each edge of the boundary, sorted by edge.
std::vector<Meeting> meetings(const Domain& domain) {
  std::vector<Meeting> all;
  all.reserve(3 * domain.facets.size());
  for (std::size_t f = 0; f < domain.facets.size(); ++f)
    for (int e = 0; e < 3; ++e) {
      const std::int32_t a = domain.facets[f].vertices[e], b = domain.facets[f].vertices[(e + 1) % 3];
      all.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(f)});
    }
  std::sort(all.begin(), all.end(), [](const Meeting& a, const Meeting& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.facet < b.facet;
  });
  return all;
}

template <class F>
void for_each_edge(const std::vector<Meeting>& all, F&& f) {
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i + 1;
    while (j < all.size() && all[j].edge == all[i].edge)
      ++j;
    f(i, j);
    i = j;
  }
}

/// Feature edges at each vertex that has any.
std::map<std::int32_t, std::vector<std::int32_t>> edges_at_vertices(const Domain& domain) {
  std::map<std::int32_t, std::vector<std::int32_t>> at;
  for (std::size_t e = 0; e < domain.feature_edges.size(); ++e)
    for (const std::int32_t v : domain.feature_edges[e].vertices)
      at[v].push_back(static_cast<std::int32_t>(e));
  return at;
}

} // namespace

void surfaces_by_angle(Domain& domain, double degrees) {
  std::vector<std::vector<std::int32_t>> smooth(domain.facets.size()); // neighbours without a crease between
  const auto all = meetings(domain);
  for_each_edge(all, [&](std::size_t i, std::size_t j) {
    if (j - i != 2)
      return;
    const std::int32_t f = all[i].facet, g = all[i + 1].facet;
    if (degrees_between(area_vector(domain, domain.facets[f]), area_vector(domain, domain.facets[g])) >
        degrees)
      return;
    smooth[f].push_back(g);
    smooth[g].push_back(f);
  });
  for (auto& facet : domain.facets)
    facet.surface = -1;
  domain.surfaces.clear();
  std::vector<std::int32_t> waiting;
  for (std::size_t seed = 0; seed < domain.facets.size(); ++seed) {
    if (domain.facets[seed].surface >= 0)
      continue;
    const auto surface = static_cast<std::int32_t>(domain.surfaces.size());
    domain.surfaces.push_back(fmt::format("face{}", surface + 1));
    domain.facets[seed].surface = surface;
    waiting.push_back(static_cast<std::int32_t>(seed));
    while (!waiting.empty()) {
      const std::int32_t f = waiting.back();
      waiting.pop_back();
      for (const std::int32_t g : smooth[f])
        if (domain.facets[g].surface < 0) {
          domain.facets[g].surface = surface;
          waiting.push_back(g);
        }
    }
  }
}

void find_feature_edges(Domain& domain, double degrees) {
  domain.feature_edges.clear();
  const auto all = meetings(domain);
  for_each_edge(all, [&](std::size_t i, std::size_t j) {
    bool feature = j - i != 2;
    for (std::size_t k = i + 1; k < j && !feature; ++k) {
      const auto &f = domain.facets[all[i].facet], &g = domain.facets[all[k].facet];
      feature =
          f.surface != g.surface || degrees_between(area_vector(domain, f), area_vector(domain, g)) > degrees;
    }
    if (feature)
      domain.feature_edges.push_back({all[i].edge, -1});
  });
}

void find_corners(Domain& domain, const CornerRule& rule) {
  domain.corners.clear();
  const auto candidate = [&](std::int32_t v) { return !rule.candidate || rule.candidate(v); };
  const auto at = edges_at_vertices(domain);
  for (const auto& [v, edges] : at) {
    if (!candidate(v))
      continue;
    bool corner = edges.size() != 2 || (domain.dimension == 2 && domain.feature_edges[edges[0]].curve !=
                                                                     domain.feature_edges[edges[1]].curve);
    if (!corner) {
      std::optional<double> kink;
      if (rule.kink)
        kink = rule.kink(v);
      if (!kink) {
        Vec3 away[2];
        for (int k = 0; k < 2; ++k) {
          const auto& [a, b] = domain.feature_edges[edges[k]].vertices;
          away[k] = domain.vertices[a == v ? b : a] - domain.vertices[v];
        }
        kink = degrees_between(away[0], -away[1]);
      }
      corner = *kink > rule.largest_kink;
    }
    if (corner)
      domain.corners.push_back(v);
  }

  std::map<std::int32_t, std::vector<Vec3>> around; // unit normals around candidates off all features
  for (const auto& facet : domain.facets)
    for (const std::int32_t v : facet.vertices)
      if (rule.candidate && !at.contains(v) && rule.candidate(v))
        around[v].push_back(area_vector(domain, facet).normalized());
  for (const auto& [v, normals] : around) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& normal : normals)
      mean += normal;
    if (std::any_of(normals.begin(), normals.end(), [&, &mean = mean](const Vec3& n) {
          return degrees_between(n, mean) > rule.largest_tilt;
        }))
      domain.corners.push_back(v);
  }
  std::sort(domain.corners.begin(), domain.corners.end());
}

void chain_curves(Domain& domain) {
  std::map<Edge, std::vector<std::int32_t>> surfaces; // of each feature edge, sorted
  const auto all = meetings(domain);
  for_each_edge(all, [&](std::size_t i, std::size_t j) {
    auto& list = surfaces[all[i].edge];
    for (std::size_t k = i; k < j; ++k)
      list.push_back(domain.facets[all[k].facet].surface);
    std::sort(list.begin(), list.end());
  });
  const auto at = edges_at_vertices(domain);
  std::int32_t curve = -1;
  for (const auto& edge : domain.feature_edges)
    curve = std::max(curve, edge.curve);
  std::vector<std::int32_t> waiting;
  for (std::size_t seed = 0; seed < domain.feature_edges.size(); ++seed) {
    if (domain.feature_edges[seed].curve >= 0)
      continue;
    domain.feature_edges[seed].curve = ++curve;
    const auto& between = surfaces[domain.feature_edges[seed].vertices];
    waiting.push_back(static_cast<std::int32_t>(seed));
    while (!waiting.empty()) {
      const std::int32_t e = waiting.back();
      waiting.pop_back();
      for (const std::int32_t v : domain.feature_edges[e].vertices) {
        if (std::binary_search(domain.corners.begin(), domain.corners.end(), v))
          continue;
        for (const std::int32_t next : at.at(v))
          if (domain.feature_edges[next].curve < 0 &&
              surfaces[domain.feature_edges[next].vertices] == between) {
            domain.feature_edges[next].curve = curve;
            waiting.push_back(next);
          }
      }
    }
  }
}

} // namespace tessera::preprocess
