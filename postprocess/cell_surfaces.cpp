#include "postprocess/cell_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace tessera::post {
namespace {

using Loop = std::vector<std::int32_t>;

/// Faces of a curved boundary meet at less, faces of a cell at more.
const double least_cosine = std::cos(15 * M_PI / 180);

/// For each of `points` (indices into `positions`) the one it is taken for.
std::map<std::int32_t, std::int32_t> welded(const std::vector<Vec3>& positions, Loop points,
                                            double tolerance) {
  std::sort(points.begin(), points.end(), [&](std::int32_t a, std::int32_t b) {
    return std::make_pair(positions[a].x(), a) < std::make_pair(positions[b].x(), b);
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::map<std::int32_t, std::int32_t> same;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& x = positions[points[i]];
    std::int32_t first = points[i];
    for (std::size_t j = i; j-- > 0 && x.x() - positions[points[j]].x() <= tolerance;)
      if ((x - positions[points[j]]).norm() <= tolerance) {
        first = same.at(points[j]);
        break;
      }
    same[points[i]] = first;
  }
  return same;
}

/// The loop without points that became one; empty where no face is left.
Loop joined(const Loop& loop, const std::map<std::int32_t, std::int32_t>& same) {
  Loop out;
  for (const std::int32_t p : loop)
    if (const std::int32_t q = same.at(p); out.empty() || out.back() != q)
      out.push_back(q);
  while (out.size() > 1 && out.front() == out.back())
    out.pop_back();
  return out.size() < 3 ? Loop{} : out;
}

/// Unit normal of a polygon.
Vec3 normal_of(const std::vector<Vec3>& points, const Loop& loop) {
  Vec3 area = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    area += (points[loop[k]] - points[loop[0]]).cross(points[loop[k + 1]] - points[loop[0]]);
  return area.normalized();
}

/// One cell from the faces of all its pieces: adds its outer faces and edges.
void add_cell(const CellMesh& mesh, std::int32_t particle, const std::vector<const Loop*>& loops,
              double tolerance, CellSurfaces& surfaces) {
  Loop used;
  for (const Loop* loop : loops)
    used.insert(used.end(), loop->begin(), loop->end());
  const auto same = welded(mesh.points, used, tolerance);

  // Two pieces share the face between them; the outer ones appear once.
  std::map<Loop, std::pair<Loop, int>> faces;
  for (const Loop* loop : loops) {
    Loop face = joined(*loop, same);
    if (face.empty())
      continue;
    Loop key = face;
    std::sort(key.begin(), key.end());
    auto& [kept, times] = faces[key];
    kept = std::move(face);
    ++times;
  }
  struct Sides {
    Vec3 normal = Vec3::Zero();
    int count = 0;
    bool sharp = false;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Sides> sides;
  std::map<std::int32_t, std::int32_t> place; // in surfaces.points
  const auto placed = [&](std::int32_t p) {
    const auto [found, fresh] = place.try_emplace(p, static_cast<std::int32_t>(surfaces.points.size()));
    if (fresh)
      surfaces.points.push_back(mesh.points[p]);
    return found->second;
  };
  for (const auto& [key, face] : faces) {
    const auto& [loop, times] = face;
    if (times > 1)
      continue;
    const Vec3 normal = normal_of(mesh.points, loop);
    auto& out = surfaces.faces.emplace_back(CellSurfaces::Face{particle, {}});
    for (std::size_t k = 0; k < loop.size(); ++k) {
      out.loop.push_back(placed(loop[k]));
      Sides& edge = sides[std::minmax(loop[k], loop[(k + 1) % loop.size()])];
      edge.sharp = edge.count > 0 && edge.normal.dot(normal) < least_cosine;
      edge.normal = normal;
      ++edge.count;
    }
  }
  for (const auto& [ends, edge] : sides)
    if (edge.sharp || edge.count != 2)
      surfaces.edges.push_back({placed(ends.first), placed(ends.second)});
}

} // namespace

CellSurfaces cell_surfaces(const CellMesh& mesh, const std::vector<bool>& shown, double tolerance) {
  std::vector<std::size_t> order(mesh.cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return mesh.cells[a].particle < mesh.cells[b].particle;
  });
  CellSurfaces surfaces;
  for (std::size_t i = 0; i < order.size();) {
    const std::int32_t particle = mesh.cells[order[i]].particle;
    std::vector<const Loop*> loops;
    for (; i < order.size() && mesh.cells[order[i]].particle == particle; ++i)
      for (const Loop& loop : mesh.cells[order[i]].faces)
        loops.push_back(&loop);
    if (particle >= 0 && static_cast<std::size_t>(particle) < shown.size() &&
        shown[static_cast<std::size_t>(particle)])
      add_cell(mesh, particle, loops, tolerance, surfaces);
  }
  return surfaces;
}

} // namespace tessera::post
