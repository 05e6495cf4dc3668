#include "preprocess/geometry/boundary.hpp"

#include <algorithm>

namespace tessera::preprocess {
namespace {

struct Face {
  std::array<std::int32_t, 3> key; ///< sorted vertices
  std::int32_t tet;
  int local;
};

} // namespace

std::vector<Domain::Facet> boundary_of(const std::vector<std::array<std::int32_t, 4>>& tets) {
  std::vector<Face> faces;
  faces.reserve(4 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (int f = 0; f < 4; ++f) {
      std::array<std::int32_t, 3> key{tets[t][tet_faces[f][0]], tets[t][tet_faces[f][1]],
                                      tets[t][tet_faces[f][2]]};
      std::sort(key.begin(), key.end());
      faces.push_back({key, static_cast<std::int32_t>(t), f});
    }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.key != b.key ? a.key < b.key : a.tet < b.tet; });

  std::vector<std::pair<std::int32_t, int>> outer;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i + 1;
    while (j < faces.size() && faces[j].key == faces[i].key)
      ++j;
    if (j == i + 1)
      outer.emplace_back(faces[i].tet, faces[i].local);
    i = j;
  }
  std::sort(outer.begin(), outer.end());

  std::vector<Domain::Facet> facets;
  facets.reserve(outer.size());
  for (const auto& [t, f] : outer)
    facets.push_back({{tets[t][tet_faces[f][0]], tets[t][tet_faces[f][1]], tets[t][tet_faces[f][2]]}, -1, t});
  return facets;
}

} // namespace tessera::preprocess
