#include "preprocess/voronoi/orphans.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <limits>

namespace tessera::preprocess {
namespace {

/// Parts below this fraction of a cell are rounding, not material across a gap.
constexpr double smallest_part = 1e-9;

/// One connected part of a cell.
struct Part {
  double volume = 0;
  Vec3 moment = Vec3::Zero(); ///< about the cell's seed
  std::vector<SurfaceShare> shares;
  double from_seed =
      std::numeric_limits<double>::infinity(); ///< how far outside its tetrahedra the seed lies
  struct Contact {
    std::int32_t neighbour, tet;
    double area;
  };
  std::vector<Contact> contacts; ///< across bisectors
  std::vector<std::int32_t> tets;
  double largest = 0;         ///< volume of its largest convex piece
  Vec3 within = Vec3::Zero(); ///< that piece's centroid
  std::int32_t receiver = -1; ///< who owns it: its own cell, or who got it; -1: not known yet
};

/// A cell of several parts.
struct SplitCell {
  std::vector<Part> parts;
  std::size_t own = 0; ///< the part that hangs together with the seed
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

SplitCell split_cell(const RestrictedVoronoi& voronoi, std::int64_t i) {
  const TetBody& body = voronoi.body();
  const Vec3& seed = voronoi.seeds()[i];
  SplitCell cell;
  auto& parts = cell.parts;
  voronoi.visit(i, [&](const CellPiece& piece) {
    if (piece.component >= static_cast<std::int32_t>(parts.size()))
      parts.emplace_back();
    Part& part = parts.back();
    const auto measure = piece.cell.measure(seed);
    part.volume += measure.volume;
    part.moment += measure.moment;
    if (measure.volume > part.largest) {
      part.largest = measure.volume;
      part.within = seed + measure.moment / measure.volume;
    }
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
  for (std::size_t p = 1; p < parts.size(); ++p)
    if (parts[p].from_seed < parts[cell.own].from_seed)
      cell.own = p;
  double whole = 0;
  for (const Part& part : parts)
    whole += part.volume;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (p == cell.own || !(parts[p].volume > smallest_part * whole))
      parts[p].receiver = static_cast<std::int32_t>(i);
  return cell;
}

/// A point inside a part: its centroid, or that of its largest piece where the part bends around a gap. (A
/// cell is convex, so the centroid can miss the part only by leaving the body.)
Vec3 point_inside(const TetBody& body, const Part& part, const Vec3& centroid) {
  const bool inside = std::any_of(part.tets.begin(), part.tets.end(),
                                  [&](std::int32_t t) { return distance_outside(body, t, centroid) <= 0; });
  return inside ? centroid : part.within;
}

/// The split cells by number.
class SplitCells {
 public:
  SplitCells(const RestrictedVoronoi& voronoi, const std::vector<std::int64_t>& split)
      : numbers_(split), cells_(split.size()) {
    for_each_uneven(static_cast<std::int64_t>(split.size()),
                    [&](std::int64_t k) { cells_[k] = split_cell(voronoi, numbers_[k]); });
  }

  std::vector<SplitCell>& cells() { return cells_; }

  /// Who owns what lies across a contact: -1 while nobody is known.
  std::int32_t owner_across(const Part::Contact& contact) const {
    const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), contact.neighbour);
    if (at == numbers_.end() || *at != contact.neighbour)
      return contact.neighbour; // of one part
    // A cell meets each tetrahedron in one convex piece, hence in one part.
    for (const Part& part : cells_[at - numbers_.begin()].parts)
      if (std::find(part.tets.begin(), part.tets.end(), contact.tet) != part.tets.end())
        return part.receiver;
    return -1;
  }

 private:
  const std::vector<std::int64_t>& numbers_;
  std::vector<SplitCell> cells_;
};

/// The one across the largest area of contact among those known; -1: none is.
std::int32_t receiver_of(const SplitCells& cells, const Part& orphan) {
  std::vector<std::pair<double, std::int32_t>> touched; // by area
  for (const auto& contact : orphan.contacts) {
    const std::int32_t owner = cells.owner_across(contact);
    if (owner < 0)
      continue;
    const auto known =
        std::find_if(touched.begin(), touched.end(), [&](const auto& t) { return t.second == owner; });
    if (known == touched.end())
      touched.emplace_back(contact.area, owner);
    else
      known->first += contact.area;
  }
  const auto most = std::min_element(touched.begin(), touched.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  return most == touched.end() ? -1 : most->second;
}

/// Orphans that touch an owner's part go first; then, ring by ring, those that touch only other orphans.
void find_receivers(SplitCells& cells) {
  std::vector<Part*> waiting;
  for (SplitCell& cell : cells.cells())
    for (Part& part : cell.parts)
      if (part.receiver < 0)
        waiting.push_back(&part);
  while (!waiting.empty()) {
    std::vector<std::int32_t> found;
    for (const Part* part : waiting)
      found.push_back(receiver_of(cells, *part));
    std::vector<Part*> still;
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      waiting[k]->receiver = found[k];
      if (found[k] < 0)
        still.push_back(waiting[k]);
    }
    if (still.size() == waiting.size())
      break; // a piece of the body without a seed
    waiting.swap(still);
  }
}

} // namespace

void add_share(std::vector<SurfaceShare>& shares, std::int32_t surface, const Vec3& area) {
  if (surface == Domain::lid)
    return;
  auto at = std::lower_bound(shares.begin(), shares.end(), surface,
                             [](const SurfaceShare& s, std::int32_t key) { return s.surface < key; });
  if (at == shares.end() || at->surface != surface)
    at = shares.insert(at, {surface, Vec3::Zero()});
  at->area += area;
}

void hand_over_orphans(const RestrictedVoronoi& voronoi, const std::vector<std::int64_t>& split,
                       CellMeasures& result) {
  const auto& seeds = voronoi.seeds();
  SplitCells split_cells(voronoi, split);
  find_receivers(split_cells);
  const auto& cells = split_cells.cells();
  for (const std::int64_t i : split) {
    result.volume[i] = 0;
    result.moment[i].setZero();
    result.shares[i].clear();
  }
  for (std::size_t k = 0; k < split.size(); ++k) {
    const auto cell = static_cast<std::int32_t>(split[k]);
    bool several = false;
    for (std::size_t p = 0; p < cells[k].parts.size(); ++p) {
      const Part& part = cells[k].parts[p];
      const bool stranded = part.receiver < 0;
      const std::int32_t receiver = stranded ? cell : part.receiver;
      if (receiver != cell || stranded) {
        const Vec3 centroid = seeds[cell] + part.moment / part.volume;
        result.orphans.push_back({cell, static_cast<std::int32_t>(p), receiver, part.volume, centroid,
                                  point_inside(voronoi.body(), part, centroid)});
        several = true;
      }
      if (stranded)
        result.stranded += part.volume;
      result.volume[receiver] += part.volume;
      result.moment[receiver] += part.moment + part.volume * (seeds[cell] - seeds[receiver]);
      for (const auto& share : part.shares)
        add_share(result.shares[receiver], share.surface, share.area);
    }
    result.disconnected += several;
  }
}

} // namespace tessera::preprocess
