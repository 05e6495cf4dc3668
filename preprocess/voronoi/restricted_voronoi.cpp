#include "preprocess/voronoi/restricted_voronoi.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

/// Bisector of two seeds: d(x) = n.(x - m) is positive on the side of b. Exchanging the seeds changes the
/// sign of n and nothing else, so that both cells see one and the same plane.
struct Bisector {
  Vec3 normal, middle;
  Bisector(const Vec3& a, const Vec3& b) : normal(b - a), middle((a + b) * 0.5) {}
  double operator()(const Vec3& x) const { return normal.dot(x - middle); }
};

/// A facet's part in one cell: a convex polygon whose sides remember the neighbour behind them (-1: the
/// facet's own).
class Polygon {
 public:
  void set(const Vec3& a, const Vec3& b, const Vec3& c) {
    points_.assign({a, b, c});
    labels_.assign({-1, -1, -1});
  }

  /// Keeps the part where plane(x) <= 0, down to single points. False when nothing is left.
  bool clip(const Bisector& plane, std::int32_t label) {
    const std::size_t n = points_.size();
    height_.resize(n);
    bool any_lost = false;
    for (std::size_t k = 0; k < n; ++k) {
      height_[k] = plane(points_[k]);
      any_lost |= height_[k] > 0;
    }
    if (!any_lost)
      return true;
    next_points_.clear();
    next_labels_.clear();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t l = (k + 1) % n;
      const bool kept = !(height_[k] > 0), next_kept = !(height_[l] > 0);
      if (kept) {
        next_points_.push_back(points_[k]);
        next_labels_.push_back(labels_[k]);
      }
      if (kept == next_kept)
        continue;
      const double whole = height_[l] - height_[k];
      next_points_.push_back(points_[k] * (height_[l] / whole) - points_[l] * (height_[k] / whole));
      next_labels_.push_back(kept ? label : labels_[k]);
    }
    points_.swap(next_points_);
    labels_.swap(next_labels_);
    return !points_.empty();
  }

  const std::vector<std::int32_t>& labels() const { return labels_; }

 private:
  std::vector<Vec3> points_, next_points_;
  std::vector<std::int32_t> labels_, next_labels_; ///< of the side that begins at each point
  std::vector<double> height_;
};

} // namespace

RestrictedVoronoi::RestrictedVoronoi(const TetBody& body, const std::vector<Vec3>& seeds,
                                     const DelaunayGraph& graph, Backend backend)
    : body_(&body), seeds_(&seeds), graph_(&graph), backend_(backend) {
  find_boundary_cells();
}

std::int32_t RestrictedVoronoi::locate(const Vec3& point, std::int32_t start) const {
  // Greedy walks end at the nearest point on any graph that holds the Delaunay edges; rounding could make one
  // circle among equals, hence the bound on steps.
  for (std::int64_t step = 0; step < size(); ++step) {
    double most = 0;
    std::int32_t next = -1;
    for (const std::int32_t j : graph_->of(start)) {
      const double beyond = Bisector((*seeds_)[start], (*seeds_)[j])(point);
      if (beyond > most) {
        most = beyond;
        next = j;
      }
    }
    if (next < 0)
      break;
    start = next;
  }
  return start;
}

void RestrictedVoronoi::find_boundary_cells() {
  const auto& facets = body_->domain->facets;
  const auto count = static_cast<std::int64_t>(facets.size());
  constexpr std::int64_t block = 64;
  const std::int64_t blocks = (count + block - 1) / block;
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> met(blocks); // (cell, facet)
  for_each_task(blocks, [&](std::int64_t b) {
    Polygon polygon;
    std::vector<std::int32_t> reached;
    std::int32_t hint = 0;
    for (std::int64_t f = b * block; f < std::min(count, (b + 1) * block); ++f) {
      if (facets[f].surface == Domain::lid)
        continue; // whoever meets only lids lies inside the plane body
      const auto& corners = facets[f].vertices;
      hint = locate(body_->points[corners[0]], hint);
      reached.assign(1, hint);
      for (std::size_t k = 0; k < reached.size(); ++k) {
        const std::int32_t i = reached[k];
        polygon.set(body_->points[corners[0]], body_->points[corners[1]], body_->points[corners[2]]);
        bool any = true;
        for (const std::int32_t j : graph_->of(i)) {
          any = polygon.clip(Bisector((*seeds_)[i], (*seeds_)[j]), j);
          if (!any)
            break;
        }
        if (!any)
          continue;
        met[b].emplace_back(i, static_cast<std::int32_t>(f));
        for (const std::int32_t j : polygon.labels())
          if (j >= 0 && std::find(reached.begin(), reached.end(), j) == reached.end())
            reached.push_back(j);
      }
    }
  });

  rows_.assign(size() + 1, 0);
  for (const auto& part : met)
    for (const auto& [cell, facet] : part)
      ++rows_[cell + 1];
  for (std::int64_t i = 0; i < size(); ++i)
    rows_[i + 1] += rows_[i];
  facets_.resize(rows_.back());
  std::vector<std::int64_t> fill(rows_.begin(), rows_.end() - 1);
  for (const auto& part : met)
    for (const auto& [cell, facet] : part)
      facets_[fill[cell]++] = facet;
}

bool RestrictedVoronoi::on_upper_lid(const CellPiece& piece, const ConvexCell::Face& face) const {
  if (body_->domain->dimension != 2)
    return false;
  if (piece.tet < 0)
    return face.label == ConvexCell::upper_lid;
  const std::int32_t facet = facet_of(piece, face);
  return facet >= 0 && body_->domain->facets[facet].surface == Domain::lid &&
         body_->points[body_->domain->facets[facet].vertices[0]].z() > 0;
}

RestrictedVoronoi::Workspace& RestrictedVoronoi::workspace() {
  thread_local Workspace work;
  return work;
}

void RestrictedVoronoi::begin_round(Workspace& work) const {
  if (work.met.size() < body_->across.size())
    work.met.resize(body_->across.size(), 0);
  if (++work.round == 0) {
    std::fill(work.met.begin(), work.met.end(), 0);
    work.round = 1;
  }
}

/// The tetrahedra that share a vertex with one of the facets and hang together around it.
std::vector<std::int32_t> RestrictedVoronoi::tets_around(std::span<const std::int32_t> facets) const {
  const Domain& domain = *body_->domain;
  std::vector<std::int32_t> around;
  const auto known = [&](std::int32_t t) {
    return std::find(around.begin(), around.end(), t) != around.end();
  };
  for (const std::int32_t f : facets) {
    const auto& corners = domain.facets[f].vertices;
    const auto touches = [&](std::int32_t t) {
      return std::find_first_of(domain.tets[t].begin(), domain.tets[t].end(), corners.begin(),
                                corners.end()) != domain.tets[t].end();
    };
    std::size_t next = around.size();
    if (!known(domain.facets[f].tet))
      around.push_back(domain.facets[f].tet);
    for (; next < around.size(); ++next)
      for (const std::int32_t t : body_->across[around[next]])
        if (t >= 0 && touches(t) && !known(t))
          around.push_back(t);
  }
  return around;
}

bool RestrictedVoronoi::cut_by_bisectors(std::int64_t i, ConvexCell& cell) const {
  const Vec3& seed = (*seeds_)[i];
  double reach = cell.squared_radius(seed);
  for (const std::int32_t j : graph_->of(i)) {
    const Bisector plane(seed, (*seeds_)[j]);
    // Neighbours come nearest first: from twice the cell's radius on, none can cut (a hair of slack for
    // rounding).
    if (plane.normal.squaredNorm() > 4.000001 * reach)
      break;
    if (!cell.clip(plane.normal, plane.middle, j))
      return false;
    if (cell.faces().back().label == j)
      reach = cell.squared_radius(seed);
  }
  return true;
}

void RestrictedVoronoi::cut_whole(std::int64_t i, Workspace& work) const {
  // A box around the seed is cut; where some of it is left the box was too small.
  const Vec3& seed = (*seeds_)[i];
  const auto neighbours = graph_->of(i);
  const Vec3 extent = (body_->domain->upper - body_->domain->lower) / body_->scaling.length;
  const double whole = 2 * extent.norm();
  double half = neighbours.empty() ? whole : 1.5 * (seed - (*seeds_)[neighbours.back()]).norm();
  const bool plane = body_->domain->dimension == 2;
  const auto final = [&](const ConvexCell::Face& face) {
    return face.label >= 0 || (plane && face.label <= ConvexCell::lower_lid);
  };
  for (;; half *= 4) {
    const Vec3 size(half, half, plane ? 0.5 : half);
    if (backend_ == Backend::voro) {
      work.voro.cut_box(seed - size, seed + size, *seeds_, i, neighbours, work.cell);
    } else {
      work.cell.set_box(seed - size, seed + size);
      cut_by_bisectors(i, work.cell);
    }
    const auto faces = work.cell.faces();
    if (half >= whole || std::all_of(faces.begin(), faces.end(), final))
      return;
  }
}

bool RestrictedVoronoi::cut_tetrahedron(std::int64_t i, std::int32_t t, Workspace& work) const {
  const auto& tet = body_->domain->tets[t];
  const auto& points = body_->points;
  if (backend_ == Backend::voro)
    return work.voro.cut_tetrahedron({points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]},
                                     *seeds_, i, graph_->of(i), work.cell);
  work.cell.set_tetrahedron(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]);
  return cut_by_bisectors(i, work.cell);
}

} // namespace tessera::preprocess
