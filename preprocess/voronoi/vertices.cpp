#include "preprocess/voronoi/vertices.hpp"

#include "core/parallel.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <limits>

namespace tessera::preprocess {
namespace {

/// A vertex found by a cell, which is the lowest-numbered of the seeds around it.
struct Found {
  Vec3 x;
  std::array<std::int32_t, 3>
      others;         ///< the other seeds, ascending; on a surface and in a slab the third is -1
  std::int32_t facet; ///< -1 inside
};

/// One plane n.x = h of the three that meet at a vertex, in coordinates around the seed.
struct Plane {
  Vec3 normal;
  double height;
};

/// The point common to three planes. A cut's own vertex carries the rounding of all cuts before it; this one
/// is equally far from its seeds to the last bits. Near-parallel planes keep the cut's vertex.
Vec3 sharpened(const std::array<Plane, 3>& planes, const Vec3& seed, const Vec3& cut) {
  Mat3 rows;
  Vec3 heights;
  for (int r = 0; r < 3; ++r) {
    const double size = planes[r].normal.norm();
    rows.row(r) = planes[r].normal.transpose() / size;
    heights[r] = planes[r].height / size;
  }
  const Vec3 x = seed + rows.partialPivLu().solve(heights);
  return (x - cut).norm() < 1e-6 ? x : cut;
}

class Collector {
 public:
  explicit Collector(const RestrictedVoronoi& voronoi) : voronoi_(voronoi), body_(voronoi.body()) {}

  void collect(std::int64_t i, std::vector<Found>& found) const {
    thread_local std::vector<ConvexCell::Corner> corners;
    voronoi_.visit(i, [&](const CellPiece& piece) {
      if (plane_) {
        collect_on_lid(i, piece, found);
        return;
      }
      piece.cell.corners(corners);
      for (std::size_t v = 0; v < corners.size(); ++v)
        if (corners[v].count == 3)
          consider(i, piece, corners[v].labels, piece.cell.vertices()[v], found);
    });
  }

 private:
  void consider(std::int64_t i, const CellPiece& piece, std::array<std::int32_t, 3> labels, const Vec3& cut,
                std::vector<Found>& found) const {
    std::sort(labels.begin(), labels.end(), std::greater<>());
    if (labels[1] < i || labels[0] == labels[1] || labels[1] == labels[2])
      return;
    std::int32_t facet = -1;
    if (labels[2] < 0) {
      const std::int32_t across = piece.tet < 0 ? 0 : body_.across[piece.tet][-1 - labels[2]];
      if (across >= 0)
        return;
      facet = -1 - across;
    } else if (labels[2] < i) {
      return;
    }
    const Vec3& seed = voronoi_.seeds()[i];
    std::array<Plane, 3> planes{bisector(seed, labels[0]), bisector(seed, labels[1]), {}};
    planes[2] = facet < 0 ? bisector(seed, labels[2]) : facet_plane(seed, facet);
    Found vertex{sharpened(planes, seed, cut), {labels[1], labels[0], -1}, facet};
    if (facet < 0)
      vertex.others = {labels[2], labels[1], labels[0]};
    add(piece, vertex, found);
  }

  /// The plane's vertices are the corners between two bisectors of a piece's face on the upper lid.
  void collect_on_lid(std::int64_t i, const CellPiece& piece, std::vector<Found>& found) const {
    const auto lid = std::find_if(piece.cell.faces().begin(), piece.cell.faces().end(),
                                  [&](const auto& face) { return voronoi_.on_upper_lid(piece, face); });
    if (lid == piece.cell.faces().end())
      return;
    thread_local std::vector<ConvexCell::Corner> corners;
    piece.cell.corners(corners);
    const Vec3& seed = voronoi_.seeds()[i];
    for (const std::int32_t v : piece.cell.loop(*lid)) {
      auto labels = corners[v].labels;
      std::sort(labels.begin(), labels.end(), std::greater<>());
      if (corners[v].count != 3 || labels[1] < i || labels[0] == labels[1] || labels[2] >= 0)
        continue;
      const Vec3 cut(piece.cell.vertices()[v].x(), piece.cell.vertices()[v].y(), 0);
      const std::array<Plane, 3> planes{
          bisector(seed, labels[0]), bisector(seed, labels[1]), {Vec3::UnitZ(), 0}};
      add(piece, {sharpened(planes, seed, cut), {labels[1], labels[0], -1}, -1}, found);
    }
  }

  void add(const CellPiece& piece, const Found& vertex, std::vector<Found>& found) const {
    // A vertex on the face between two tetrahedra is met from both.
    const auto twin = [&](const Found& f) {
      return f.others == vertex.others && surface_of(f) == surface_of(vertex) &&
             (f.x - vertex.x).norm() < 1e-9;
    };
    if (piece.tet < 0 || std::none_of(found.begin(), found.end(), twin))
      found.push_back(vertex);
  }

  std::int32_t surface_of(const Found& f) const {
    return f.facet < 0 ? -1 : body_.domain->facets[f.facet].surface;
  }

  Plane bisector(const Vec3& seed, std::int32_t j) const {
    const Vec3 apart = voronoi_.seeds()[j] - seed;
    return {apart, apart.squaredNorm() / 2};
  }

  Plane facet_plane(const Vec3& seed, std::int32_t f) const {
    const auto& v = body_.domain->facets[f].vertices;
    const Vec3& a = body_.points[v[0]];
    const Vec3 normal = (body_.points[v[1]] - a).cross(body_.points[v[2]] - a);
    return {normal, normal.dot(a - seed)};
  }

  const RestrictedVoronoi& voronoi_;
  const TetBody& body_;
  const bool plane_ = body_.domain->dimension == 2;
};

/// Where the CAD curves pass from one cell to the next.
void add_curve_points(const RestrictedVoronoi& voronoi, PlacedPoints& points) {
  const TetBody& body = voronoi.body();
  const auto& seeds = voronoi.seeds();
  std::int32_t cell = 0;
  for (const auto& edge : body.domain->feature_edges) {
    const Vec3& begin = body.points[edge.vertices[0]];
    const Vec3 along = body.points[edge.vertices[1]] - begin;
    cell = voronoi.locate(begin, cell);
    // Each step goes to a seed farther along the edge, so it ends.
    for (double at = 0;;) {
      double leave = std::numeric_limits<double>::infinity();
      std::int32_t next = -1;
      for (const std::int32_t j : voronoi.graph().of(cell)) {
        const Vec3 apart = seeds[j] - seeds[cell];
        const double speed = apart.dot(along);
        if (!(speed > 0))
          continue;
        const double t = std::max(at, apart.dot((seeds[j] + seeds[cell]) / 2 - begin) / speed);
        if (t < leave) {
          leave = t;
          next = j;
        }
      }
      if (!(leave < 1))
        break;
      points.add(begin + leave * along, {1, edge.curve});
      cell = next;
      at = leave;
    }
  }
}

} // namespace

PlacedPoints cell_vertices(const RestrictedVoronoi& voronoi) {
  const TetBody& body = voronoi.body();
  const bool plane = body.domain->dimension == 2;
  const CadPlace within{static_cast<std::uint8_t>(body.domain->dimension), -1};
  PlacedPoints points;
  for (const std::int32_t v : body.domain->corners)
    points.add(body.points[v], {0, v});
  add_curve_points(voronoi, points);

  const Collector collector(voronoi);
  constexpr std::int64_t block = 64;
  const std::int64_t blocks = (voronoi.size() + block - 1) / block;
  std::vector<std::vector<Found>> found(blocks);
  for_each_task(blocks, [&](std::int64_t b) {
    std::vector<Found> of_cell;
    for (std::int64_t i = b * block; i < std::min(voronoi.size(), (b + 1) * block); ++i) {
      of_cell.clear();
      collector.collect(i, of_cell);
      found[b].insert(found[b].end(), of_cell.begin(), of_cell.end());
    }
  });
  for (const bool inside : {false, true})
    for (const auto& part : found)
      for (const Found& f : part)
        if ((f.facet < 0) == inside)
          points.add(f.x, inside ? within : CadPlace{2, body.domain->facets[f.facet].surface});
  if (plane)
    for (Vec3& x : points.X)
      x.z() = 0; // corners and curve points come from the upper rim
  return points;
}

} // namespace tessera::preprocess
