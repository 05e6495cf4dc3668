#include "preprocess/voronoi/tet_body.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

struct Face {
  std::array<std::int32_t, 2> others; ///< the two larger vertices, ascending
  std::int32_t owner;                 ///< 4 * tetrahedron + corner, or -1 - facet
};

} // namespace

Scaling scaling_for(const Domain& domain, double spacing) {
  return {(domain.lower + domain.upper) / 2, std::exp2(std::round(std::log2(spacing))), domain.dimension};
}

TetBody::TetBody(const Domain& body, const Scaling& to) : domain(&body), scaling(to) {
  points.reserve(body.vertices.size());
  for (const Vec3& X : body.vertices)
    points.push_back(scaling.in(X));

  // Faces bucketed by their smallest vertex: linear in the number of tetrahedra.
  std::vector<std::int64_t> rows(points.size() + 1, 0);
  const auto each_face = [&](auto&& visit) {
    for (std::size_t t = 0; t < body.tets.size(); ++t)
      for (int k = 0; k < 4; ++k) {
        std::array<std::int32_t, 3> key;
        for (int c = 0; c < 3; ++c)
          key[c] = body.tets[t][tet_faces[k][c]];
        std::sort(key.begin(), key.end());
        visit(key, static_cast<std::int32_t>(4 * t + k));
      }
    for (std::size_t f = 0; f < body.facets.size(); ++f) {
      std::array<std::int32_t, 3> key = body.facets[f].vertices;
      std::sort(key.begin(), key.end());
      visit(key, -1 - static_cast<std::int32_t>(f));
    }
  };
  each_face([&](const auto& key, std::int32_t) { ++rows[key[0] + 1]; });
  for (std::size_t v = 0; v < points.size(); ++v)
    rows[v + 1] += rows[v];
  std::vector<Face> faces(rows.back());
  std::vector<std::int64_t> fill(rows.begin(), rows.end() - 1);
  each_face([&](const auto& key, std::int32_t owner) { faces[fill[key[0]]++] = {{key[1], key[2]}, owner}; });

  across.resize(body.tets.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto begin = faces.begin() + rows[v], end = faces.begin() + rows[v + 1];
    std::sort(begin, end, [](const Face& a, const Face& b) {
      return a.others != b.others ? a.others < b.others : a.owner < b.owner;
    });
    for (auto at = begin; at != end; at += 2) {
      const auto mate = at + 1;
      if (mate == end || mate->others != at->others ||
          (mate + 1 != end && (mate + 1)->others == at->others) || mate->owner < 0) {
        const Vec3& X = body.vertices[v];
        throw InputError("the tetrahedra and the boundary triangles of the body do not match",
                         fmt::format("near ({:.6g}, {:.6g}, {:.6g}) m", X[0], X[1], X[2]),
                         "repair or remesh the body");
      }
      across[mate->owner / 4][mate->owner % 4] = at->owner < 0 ? at->owner : at->owner / 4;
      if (at->owner >= 0)
        across[at->owner / 4][at->owner % 4] = mate->owner / 4;
    }
  }
}

} // namespace tessera::preprocess
