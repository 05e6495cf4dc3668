#include "preprocess/geometry/importer/sew.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/importer/cad_model.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <cstdlib>

namespace tessera::importer {

void sew_surfaces(const Request& request) {
  if (!tags_of(3).empty() || tags_of(2).empty())
    return;
  const double diagonal = diagonal_of(2, tags_of(2), request.name);
  for (const double gap : {1e-7, 1e-6, 1e-5, 1e-4}) {
    gmsh::vectorpair healed;
    gmsh::model::occ::healShapes(healed, {}, gap * diagonal, true, true, true, true, true);
    gmsh::model::occ::synchronize();
    if (!tags_of(3).empty())
      return;
  }
  const auto surfaces = tags_of(2);
  gmsh::vectorpair all, free_edges;
  for (const int surface : surfaces)
    all.emplace_back(2, surface);
  gmsh::model::getBoundary(all, free_edges, true, false);
  std::string where;
  if (!free_edges.empty()) {
    Vec3 low, high;
    gmsh::model::getBoundingBox(1, std::abs(free_edges[0].second), low[0], low[1], low[2], high[0], high[1],
                                high[2]);
    const Vec3 X = (low + high) / 2;
    where = fmt::format(": {} free edge{}, the first near ({:.6g}, {:.6g}, {:.6g})", free_edges.size(),
                        free_edges.size() == 1 ? "" : "s", X[0], X[1], X[2]);
  }
  throw InputError(
      fmt::format("there is no solid in the file, and its {} surface{} not close{}", surfaces.size(),
                  surfaces.size() == 1 ? " does" : "s do", where),
      request.name,
      "join them to a solid in the CAD program, or set [geometry] dimension = 2 for a plane body");
}

} // namespace tessera::importer
