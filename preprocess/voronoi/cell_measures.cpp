#include "preprocess/voronoi/cell_measures.hpp"

#include "core/parallel.hpp"
#include "preprocess/voronoi/orphans.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

/// Whether a face lies in one of cell i's bisectors.
bool on_bisector(const RestrictedVoronoi& voronoi, std::int64_t i, const ConvexCell& cell,
                 const ConvexCell::Face& face) {
  const Vec3& seed = voronoi.seeds()[i];
  const auto row = voronoi.graph().of(i);
  return std::any_of(row.begin(), row.end(), [&](std::int32_t j) {
    const Vec3 unit = (voronoi.seeds()[j] - seed).normalized(), middle = (voronoi.seeds()[j] + seed) / 2;
    const auto loop = cell.loop(face);
    return std::all_of(loop.begin(), loop.end(), [&](std::int32_t v) {
      return std::abs(unit.dot(cell.vertices()[v] - middle)) < 1e-12;
    });
  });
}

/// Closure of a cell where a bisector coincides with a face between two tetrahedra, as meshes and lattices
/// that share planes have it: that face bounds the cell though no cut made it.
double careful_closure(const RestrictedVoronoi& voronoi, std::int64_t i) {
  std::vector<std::int32_t> tets;
  voronoi.visit(i, [&](const CellPiece& piece) { tets.push_back(piece.tet); });
  std::sort(tets.begin(), tets.end());
  Vec3 open = Vec3::Zero();
  double total = 0;
  voronoi.visit(i, [&](const CellPiece& piece) {
    for (const auto& face : piece.cell.faces()) {
      if (face.label < 0 && piece.tet >= 0) {
        const std::int32_t across = voronoi.body().across[piece.tet][-1 - face.label];
        if (across >= 0 && (std::binary_search(tets.begin(), tets.end(), across) ||
                            !on_bisector(voronoi, i, piece.cell, face)))
          continue;
      }
      const Vec3 area = piece.cell.area(face);
      open += area;
      total += area.norm();
    }
  });
  return total > 0 ? open.norm() / total : 0;
}

/// Takes rounding's z from the measures of a slab.
void flatten(CellMeasures& measures) {
  for_each(static_cast<std::int64_t>(measures.volume.size()), [&](std::int64_t i) {
    measures.moment[i].z() = 0;
    for (SurfaceShare& share : measures.shares[i])
      share.area.z() = 0;
  });
}

void add_polyhedron(const RestrictedVoronoi& voronoi, const CellPiece& piece, CellMesh::Cell cell,
                    CellMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const Vec3& v : piece.cell.vertices())
    mesh.points.push_back(voronoi.body().scaling.out(v));
  for (const auto& face : piece.cell.faces()) {
    auto& loop = cell.faces.emplace_back();
    for (const std::int32_t v : piece.cell.loop(face))
      loop.push_back(first + v);
  }
  mesh.cells.push_back(std::move(cell));
}

/// What a plane cell shows on the upper lid; of the three tetrahedra of a prism one lies there.
void add_polygons(const RestrictedVoronoi& voronoi, const CellPiece& piece, const CellMesh::Cell& owner,
                  CellMesh& mesh) {
  for (const auto& face : piece.cell.faces()) {
    if (!voronoi.on_upper_lid(piece, face))
      continue;
    CellMesh::Cell cell = owner;
    auto& loop = cell.faces.emplace_back();
    for (const std::int32_t v : piece.cell.loop(face)) {
      const Vec3& x = piece.cell.vertices()[v];
      loop.push_back(static_cast<std::int32_t>(mesh.points.size()));
      mesh.points.push_back(voronoi.body().scaling.out(Vec3(x.x(), x.y(), 0)));
    }
    mesh.cells.push_back(std::move(cell));
  }
}

} // namespace

CellMeasures measure_cells(const RestrictedVoronoi& voronoi) {
  const std::int64_t n = voronoi.size();
  const TetBody& body = voronoi.body();
  CellMeasures result;
  result.volume.assign(n, 0);
  result.moment.assign(n, Vec3::Zero());
  result.shares.resize(n);
  std::vector<double> closure(n, 0);
  std::vector<std::uint8_t> several(n, 0);
  for_each_uneven(n, [&](std::int64_t i) {
    const Vec3& seed = voronoi.seeds()[i];
    Vec3 open = Vec3::Zero();
    double total = 0;
    voronoi.visit(i, [&](const CellPiece& piece) {
      const auto measure = piece.cell.measure(seed);
      result.volume[i] += measure.volume;
      result.moment[i] += measure.moment;
      several[i] |= piece.component > 0;
      for (const auto& face : piece.cell.faces()) {
        const std::int32_t facet = voronoi.facet_of(piece, face);
        if (face.label < 0 && piece.tet >= 0 && facet < 0)
          continue; // met once more, from the tetrahedron on the other side
        const Vec3 area = piece.cell.area(face);
        open += area;
        total += area.norm();
        if (facet >= 0)
          add_share(result.shares[i], body.domain->facets[facet].surface, area);
      }
    });
    if (total > 0)
      closure[i] = open.norm() / total;
    if (closure[i] > 1e-13)
      closure[i] = careful_closure(voronoi, i);
  });
  result.closure_error = max_of(n, 0, [&](std::int64_t i) { return closure[i]; });
  std::vector<std::int64_t> split;
  for (std::int64_t i = 0; i < n; ++i)
    if (several[i])
      split.push_back(i);
  hand_over_orphans(voronoi, split, result);
  if (body.domain->dimension == 2)
    flatten(result);
  return result;
}

CellMesh collect_cells(const RestrictedVoronoi& voronoi, const CellMeasures& measures) {
  const bool plane = voronoi.body().domain->dimension == 2;
  CellMesh mesh;
  auto orphan = measures.orphans.begin();
  for (std::int64_t i = 0; i < voronoi.size(); ++i) {
    voronoi.visit(i, [&](const CellPiece& piece) {
      CellMesh::Cell cell{static_cast<std::int32_t>(i), {}};
      const auto own = std::find_if(orphan, measures.orphans.end(), [&](const CellMeasures::Orphan& o) {
        return o.cell != i || o.component == piece.component;
      });
      if (own != measures.orphans.end() && own->cell == i)
        cell.particle = own->receiver;
      if (!plane)
        add_polyhedron(voronoi, piece, cell, mesh);
      else
        add_polygons(voronoi, piece, cell, mesh);
    });
    while (orphan != measures.orphans.end() && orphan->cell == i)
      ++orphan;
  }
  return mesh;
}

} // namespace tessera::preprocess
