#include "preprocess/voronoi/cell_measures.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::preprocess {
namespace {

/// Parts below this fraction of a cell are rounding, not material across a gap.
constexpr double smallest_part = 1e-9;

void add_share(std::vector<SurfaceShare>& shares, std::int32_t surface, const Vec3& area) {
  if (surface == Domain::lid)
    return;
  auto at = std::lower_bound(shares.begin(), shares.end(), surface,
                             [](const SurfaceShare& s, std::int32_t key) { return s.surface < key; });
  if (at == shares.end() || at->surface != surface)
    at = shares.insert(at, {surface, Vec3::Zero()});
  at->area += area;
}

/// One connected part of a cell.
struct Part {
  double volume = 0;
  Vec3 moment = Vec3::Zero();
  std::vector<SurfaceShare> shares;
  double from_seed =
      std::numeric_limits<double>::infinity(); ///< how far outside its tetrahedra the seed lies
  struct Contact {
    std::int32_t neighbour, tet;
    double area;
  };
  std::vector<Contact> contacts; ///< across bisectors
  std::vector<std::int32_t> tets;
};

/// How far a point lies outside a tetrahedron: the largest signed distance from its four planes.
double distance_outside(const TetBody& body, std::int32_t t, const Vec3& point) {
  const auto& tet = body.domain->tets[t];
  ConvexCell cell;
  cell.set_tetrahedron(body.points[tet[0]], body.points[tet[1]], body.points[tet[2]], body.points[tet[3]]);
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& face : cell.faces())
    most = std::max(most, cell.area(face).normalized().dot(point - cell.vertices()[cell.loop(face)[0]]));
  return most;
}

/// All parts of cell i with what a split cell needs to know; the slow and rare way.
std::vector<Part> parts_of(const RestrictedVoronoi& voronoi, std::int64_t i) {
  const TetBody& body = voronoi.body();
  const Vec3& seed = voronoi.seeds()[i];
  std::vector<Part> parts;
  voronoi.visit(i, [&](const CellPiece& piece) {
    if (piece.component >= static_cast<std::int32_t>(parts.size()))
      parts.emplace_back();
    Part& part = parts.back();
    const auto measure = piece.cell.measure(seed);
    part.volume += measure.volume;
    part.moment += measure.moment;
    part.tets.push_back(piece.tet);
    part.from_seed = std::min(part.from_seed, distance_outside(body, piece.tet, seed));
    for (const auto& face : piece.cell.faces()) {
      const Vec3 area = piece.cell.area(face);
      if (face.label >= 0)
        part.contacts.push_back({face.label, piece.tet, area.norm()});
      else if (const std::int32_t facet = voronoi.facet_of(piece, face); facet >= 0)
        add_share(part.shares, body.domain->facets[facet].surface, area);
    }
  });
  return parts;
}

std::size_t own_part(const std::vector<Part>& parts) {
  std::size_t own = 0;
  for (std::size_t p = 1; p < parts.size(); ++p)
    if (parts[p].from_seed < parts[own].from_seed)
      own = p;
  return own;
}

/// Whether the seed's own part of cell j lies in one of the tetrahedra where `orphan` touches cell j.
bool hangs_together(const RestrictedVoronoi& voronoi, const Part& orphan, std::int32_t j) {
  if (!voronoi.meets_boundary(j))
    return true;
  const auto parts = parts_of(voronoi, j);
  const auto& tets = parts[own_part(parts)].tets;
  return std::any_of(orphan.contacts.begin(), orphan.contacts.end(), [&](const Part::Contact& contact) {
    return contact.neighbour == j && std::find(tets.begin(), tets.end(), contact.tet) != tets.end();
  });
}

std::int32_t receiver_of(const RestrictedVoronoi& voronoi, const Part& orphan, std::int32_t owner) {
  std::vector<std::pair<double, std::int32_t>> touched; // by area
  for (const auto& contact : orphan.contacts) {
    const auto known = std::find_if(touched.begin(), touched.end(),
                                    [&](const auto& t) { return t.second == contact.neighbour; });
    if (known == touched.end())
      touched.emplace_back(contact.area, contact.neighbour);
    else
      known->first += contact.area;
  }
  std::sort(touched.begin(), touched.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  for (const auto& [area, j] : touched)
    if (hangs_together(voronoi, orphan, j))
      return j;
  return owner;
}

/// Takes the parts that do not hang together with their seed from the cells in `split` and hands them on.
void hand_over_orphans(const RestrictedVoronoi& voronoi, const std::vector<std::int64_t>& split,
                       CellMeasures& result) {
  const auto& seeds = voronoi.seeds();
  std::vector<std::pair<std::int32_t, Part>> handed; // receiver, part with its moment about the receiver
  for (const std::int64_t i : split) {
    const auto parts = parts_of(voronoi, i);
    const std::size_t own = own_part(parts);
    double whole = 0;
    for (const Part& part : parts)
      whole += part.volume;
    result.volume[i] = 0;
    result.moment[i].setZero();
    result.shares[i].clear();
    std::int64_t several = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Part part = parts[p];
      const bool real = part.volume > smallest_part * whole;
      several += real;
      const auto cell = static_cast<std::int32_t>(i);
      const std::int32_t receiver = p == own || !real ? cell : receiver_of(voronoi, part, cell);
      if (receiver != cell)
        result.orphans.push_back({cell, static_cast<std::int32_t>(p), receiver});
      part.moment += part.volume * (seeds[i] - seeds[receiver]);
      handed.emplace_back(receiver, std::move(part));
    }
    result.disconnected += several > 1;
  }
  for (const auto& [receiver, part] : handed) {
    result.volume[receiver] += part.volume;
    result.moment[receiver] += part.moment;
    for (const auto& share : part.shares)
      add_share(result.shares[receiver], share.surface, share.area);
  }
}

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
