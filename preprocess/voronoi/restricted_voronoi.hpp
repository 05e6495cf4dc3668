/// Voronoi cells restricted to the body, exactly, convex or not.
///
/// A cell that meets no boundary facet lies inside the body and is cut by bisectors alone. Any other cell is
/// the sum of its intersections with the tetrahedra it meets, each of them convex; they are found by flooding
/// from the tetrahedra behind the facets the cell meets.
///
/// In a slab the seeds lie at z = 0 and only walls are boundary: a cell inside is an upright prism from lid
/// to lid.
#pragma once

#include "preprocess/voronoi/backend.hpp"
#include "preprocess/voronoi/convex_cell.hpp"
#include "preprocess/voronoi/delaunay.hpp"
#include "preprocess/voronoi/tet_body.hpp"
#include "preprocess/voronoi/voro.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tessera::preprocess {

/// One convex piece of a cell. Its faces carry the label of the neighbour behind the bisector, or -1-k for
/// face k of the tetrahedron `tet` it lies in; a whole cell in a slab also has lids (ConvexCell::upper_lid).
struct CellPiece {
  const ConvexCell& cell;
  std::int32_t tet;       ///< -1: the whole cell, inside the body
  std::int32_t component; ///< pieces of one number hang together; 0 first
};

class RestrictedVoronoi {
 public:
  /// Everything in the body's scaled coordinates; all three outlive this. Finds which cells meet the
  /// boundary. The graph is delaunay_graph's or voro_neighbours'; with Backend::voro it is Voro++ that cuts.
  RestrictedVoronoi(const TetBody& body, const std::vector<Vec3>& seeds, const DelaunayGraph& graph,
                    Backend backend = Backend::clipper);

  std::int64_t size() const { return static_cast<std::int64_t>(seeds_->size()); }
  const TetBody& body() const { return *body_; }
  const std::vector<Vec3>& seeds() const { return *seeds_; }
  const DelaunayGraph& graph() const { return *graph_; }

  bool meets_boundary(std::int64_t i) const { return rows_[i + 1] > rows_[i]; }

  /// The boundary facet a piece's face lies in (lids too), -1 for bisectors, inner faces and whole cells.
  std::int32_t facet_of(const CellPiece& piece, const ConvexCell::Face& face) const {
    if (face.label >= 0 || piece.tet < 0)
      return -1;
    const std::int32_t across = body_->across[piece.tet][-1 - face.label];
    return across < 0 ? -1 - across : -1;
  }

  /// Whether a piece's face lies in the upper lid of a slab.
  bool on_upper_lid(const CellPiece& piece, const ConvexCell::Face& face) const;

  /// The seed whose cell holds `point`, walking from cell to cell beginning at `start`.
  std::int32_t locate(const Vec3& point, std::int32_t start) const;

  /// Room for one thread.
  struct Workspace {
    ConvexCell cell;
    VoroCell voro;
    std::vector<std::uint32_t> met; ///< by tetrahedron: the last round that met it
    std::uint32_t round = 0;
    std::vector<std::int32_t> front;
  };
  static Workspace& workspace(); ///< this thread's

  /// Calls visit(CellPiece) for each convex piece of cell i, components one after the other.
  template <class Visit>
  void visit(std::int64_t i, Visit&& visit) const {
    Workspace& work = workspace();
    if (!meets_boundary(i)) {
      cut_whole(i, work);
      visit(CellPiece{work.cell, -1, 0});
      return;
    }
    std::int32_t component = 0;
    const auto flood = [&](std::int32_t start) {
      if (!meet(work, start))
        return;
      work.front.assign(1, start);
      bool any = false;
      while (!work.front.empty()) {
        const std::int32_t t = work.front.back();
        work.front.pop_back();
        if (!cut_tetrahedron(i, t, work))
          continue;
        any = true;
        for (const ConvexCell::Face& face : work.cell.faces()) {
          if (face.label >= 0)
            continue;
          const std::int32_t next = body_->across[t][-1 - face.label];
          if (next >= 0 && meet(work, next))
            work.front.push_back(next);
        }
        visit(CellPiece{work.cell, t, component});
      }
      component += any;
    };
    begin_round(work);
    for (const std::int32_t facet : facets_of(i))
      flood(body_->domain->facets[facet].tet);
    if (component > 0)
      return;
    // The cell touches the boundary in points or along lines only: it lies inside (or outside) as a whole.
    const std::vector<std::int32_t> around = tets_around(facets_of(i));
    begin_round(work);
    for (const std::int32_t t : around)
      flood(t);
  }

 private:
  std::span<const std::int32_t> facets_of(std::int64_t i) const {
    return {facets_.data() + rows_[i], static_cast<std::size_t>(rows_[i + 1] - rows_[i])};
  }
  void begin_round(Workspace& work) const;
  std::vector<std::int32_t> tets_around(std::span<const std::int32_t> facets) const;
  static bool meet(Workspace& work, std::int32_t t) {
    if (work.met[t] == work.round)
      return false;
    work.met[t] = work.round;
    return true;
  }
  void cut_whole(std::int64_t i, Workspace& work) const;
  bool cut_tetrahedron(std::int64_t i, std::int32_t t, Workspace& work) const;
  bool cut_by_bisectors(std::int64_t i, ConvexCell& cell) const;
  void find_boundary_cells();

  const TetBody* body_;
  const std::vector<Vec3>* seeds_;
  const DelaunayGraph* graph_;
  Backend backend_;
  std::vector<std::int64_t> rows_;   ///< boundary facets each cell meets
  std::vector<std::int32_t> facets_; ///< ascending in each row
};

} // namespace tessera::preprocess
