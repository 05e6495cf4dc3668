#include "preprocess/geometry/domain.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

/// Edges met by an odd number of facets, each with its lower vertex first.
std::vector<std::array<std::int32_t, 2>> open_edges(const std::vector<Domain::Facet>& facets) {
  std::vector<std::array<std::int32_t, 2>> edges;
  edges.reserve(3 * facets.size());
  for (const auto& facet : facets)
    for (int e = 0; e < 3; ++e) {
      const auto [a, b] = std::minmax(facet.vertices[e], facet.vertices[(e + 1) % 3]);
      edges.push_back({a, b});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<std::array<std::int32_t, 2>> open;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j] == edges[i])
      ++j;
    if ((j - i) % 2 == 1)
      open.push_back(edges[i]);
    i = j;
  }
  return open;
}

} // namespace

double Domain::tet_volume(std::size_t t) const {
  const auto& [a, b, c, d] = tets[t];
  const Vec3& A = vertices[a];
  return (vertices[b] - A).dot((vertices[c] - A).cross(vertices[d] - A)) / 6;
}

void Domain::measure() {
  // Compensated (Neumaier), so that the total of a million tetrahedra keeps the last digits of each.
  double sum = 0, lost = 0;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const double v = tet_volume(t), next = sum + v;
    lost += std::abs(sum) >= std::abs(v) ? (sum - next) + v : (v - next) + sum;
    sum = next;
  }
  volume = sum + lost;
  lower = upper = vertices.empty() ? Vec3(Vec3::Zero()) : vertices.front();
  for (const Vec3& X : vertices) {
    lower = lower.cwiseMin(X);
    upper = upper.cwiseMax(X);
  }
  if (dimension == 2)
    lower[2] = upper[2] = 0;
}

void Domain::validate(const std::string& origin) const {
  const auto at = [&](const Vec3& X) {
    return fmt::format("{} near ({:.6g}, {:.6g}, {:.6g}) m", origin, X[0], X[1], X[2]);
  };
  const auto count = static_cast<std::int32_t>(vertices.size());
  const auto known = [&](std::int32_t v) { return v >= 0 && v < count; };

  require(dimension == 2 || dimension == 3, fmt::format("a body of dimension {}", dimension), origin,
          "bodies have 2 or 3");
  require(!tets.empty(), "the body has no volume", origin, "give a closed solid");
  for (const Vec3& X : vertices) {
    require(X.allFinite(), "a vertex is not a finite point", origin, "repair the file");
    require(dimension == 3 || std::abs(X[2]) == 0.5,
            fmt::format("a vertex of a plane body is at z = {:.6g}, on neither lid", X[2]), origin,
            "draw plane bodies out from -1/2 to 1/2");
  }
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (!std::all_of(tets[t].begin(), tets[t].end(), known))
      throw InputError(fmt::format("tetrahedron {} names a vertex that is not there", t), origin,
                       "repair the file");
    if (!(tet_volume(t) > 0))
      throw InputError(
          fmt::format("tetrahedron {} has volume {:.3g} m^3, not a positive one", t, tet_volume(t)),
          at(vertices[tets[t][0]]), "repair or remesh the body");
  }
  require(!facets.empty(), "the body has no boundary", origin, "give a closed solid");

  Vec3 closure = Vec3::Zero();
  double area = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Facet& facet = facets[f];
    const auto behind = [&](std::int32_t v) {
      const auto& tet = tets[facet.tet];
      return std::find(tet.begin(), tet.end(), v) != tet.end();
    };
    if (facet.tet < 0 || facet.tet >= static_cast<std::int32_t>(tets.size()) ||
        !std::all_of(facet.vertices.begin(), facet.vertices.end(), behind))
      throw InputError(fmt::format("boundary triangle {} is not a face of its tetrahedron", f), origin,
                       "remesh the body");
    const auto height = [&](int v) { return vertices[facet.vertices[v]][2]; };
    const bool on_lid = dimension == 2 && height(0) == height(1) && height(0) == height(2);
    if (on_lid ? facet.surface != lid
               : facet.surface < 0 || facet.surface >= static_cast<std::int32_t>(surfaces.size()))
      throw InputError(on_lid ? fmt::format("boundary triangle {} is a lid's but lies on a surface", f)
                              : fmt::format("boundary triangle {} lies on no surface", f),
                       origin, "repair the file");
    const Vec3 &A = vertices[facet.vertices[0]], &B = vertices[facet.vertices[1]],
               &C = vertices[facet.vertices[2]];
    const Vec3 normal = (B - A).cross(C - A) / 2;
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t v : tets[facet.tet])
      centre += vertices[v] / 4;
    if (!(normal.dot(A - centre) > 0))
      throw InputError(fmt::format("boundary triangle {} faces inwards", f), at(A),
                       "repair or remesh the body");
    closure += normal;
    area += normal.norm();
  }

  const auto open = open_edges(facets);
  if (!open.empty())
    throw InputError(fmt::format("the surface is open: {} edge{} with a side missing", open.size(),
                                 open.size() == 1 ? "" : "s"),
                     at((vertices[open[0][0]] + vertices[open[0][1]]) / 2), "close the holes in the surface");
  require(closure.norm() <= 1e-9 * area, "the surface does not close: its area vectors do not sum to zero",
          origin, "close the holes in the surface");
  require(std::isfinite(volume) && volume > 0, "the volume was not measured", origin, "call measure() first");
}

} // namespace tessera::preprocess
