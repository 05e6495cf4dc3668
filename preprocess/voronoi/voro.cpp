#include "preprocess/voronoi/voro.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "preprocess/voronoi/simplices.hpp"

#include <fmt/format.h>
#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tessera::preprocess {
namespace {

constexpr double enlarged = 8;

/// Seeds in Voro++'s box of blocks, about five a block.
class Box {
 public:
  Box(const TetBody& body, const std::vector<Vec3>& seeds)
      : Box(corners(body, seeds), static_cast<double>(seeds.size())) {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const Vec3 x = enlarged * seeds[i];
      container_.put(static_cast<int>(i), x[0], x[1], x[2]);
    }
  }

  std::int64_t blocks() const { return container_.nxyz; }

  /// Calls visit(seed, neighbours) for the seeds of blocks [begin, end).
  template <class Visit>
  void visit(std::int64_t begin, std::int64_t end, Visit&& visit) {
    voro::voro_compute<voro::container> compute(container_, container_.nx, container_.ny, container_.nz);
    voro::voronoicell_neighbor cell;
    std::vector<int> neighbours;
    for (auto ijk = static_cast<int>(begin); ijk < end; ++ijk) {
      const int i = ijk % container_.nx, j = ijk / container_.nx % container_.ny,
                k = ijk / (container_.nx * container_.ny);
      for (int q = 0; q < container_.co[ijk]; ++q) {
        const int seed = container_.id[ijk][q];
        if (!compute.compute_cell(cell, ijk, q, i, j, k))
          throw RunError(fmt::format("Voro++ lost the cell of point {}", seed), "Voronoi tessellation",
                         "use backend = \"clipper\"");
        cell.neighbors(neighbours);
        visit(seed, neighbours);
      }
    }
  }

 private:
  using Corners = std::pair<Vec3, Vec3>;

  static Corners corners(const TetBody& body, const std::vector<Vec3>& seeds) {
    Vec3 lower = body.points[0], upper = body.points[0];
    const auto take = [&](const Vec3& x) {
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    };
    std::for_each(body.points.begin(), body.points.end(), take);
    std::for_each(seeds.begin(), seeds.end(), take);
    return {enlarged * (lower - Vec3::Constant(0.5)), enlarged * (upper + Vec3::Constant(0.5))};
  }

  Box(const Corners& c, double seeds)
      : Box(c, c.second - c.first, std::cbrt((c.second - c.first).prod() / std::max(1.0, seeds / 5))) {}
  Box(const Corners& c, const Vec3& size, double side)
      : container_(c.first[0], c.second[0], c.first[1], c.second[1], c.first[2], c.second[2],
                   blocks_along(size[0], side), blocks_along(size[1], side), blocks_along(size[2], side),
                   false, false, false, 8) {}
  static int blocks_along(double length, double side) {
    return static_cast<int>(std::clamp(std::ceil(length / side), 1.0, 1000.0));
  }

  voro::container container_;
};

} // namespace

DelaunayGraph voro_neighbours(const TetBody& body, const std::vector<Vec3>& seeds) {
  refuse_coinciding(seeds);
  Box box(body, seeds);
  constexpr std::int64_t parts = 64;
  std::vector<std::vector<Simplex>> pairs(parts);
  for_each_task(parts, [&](std::int64_t p) {
    box.visit(box.blocks() * p / parts, box.blocks() * (p + 1) / parts,
              [&](int seed, const std::vector<int>& neighbours) {
                for (const int j : neighbours)
                  if (j >= 0)
                    pairs[p].push_back({seed, j, -1, -1});
              });
  });
  std::vector<Simplex> all;
  for (const auto& part : pairs)
    all.insert(all.end(), part.begin(), part.end());
  return graph_of(seeds, all);
}

struct VoroCell::Cell {
  voro::voronoicell_neighbor cell;
  std::vector<double> vertices;
  std::vector<int> loops, labels;
};

VoroCell::VoroCell() : cell_(std::make_unique<Cell>()) {}
VoroCell::~VoroCell() = default;

void VoroCell::cut_box(const Vec3& lower, const Vec3& upper, const std::vector<Vec3>& seeds,
                       std::int64_t seed, std::span<const std::int32_t> neighbours, ConvexCell& result) {
  const Vec3 l = enlarged * (lower - seeds[seed]), u = enlarged * (upper - seeds[seed]);
  cell_->cell.init(l[0], u[0], l[1], u[1], l[2], u[2]);
  cut(seeds, seed, neighbours, result);
}

bool VoroCell::cut_tetrahedron(const std::array<Vec3, 4>& corners, const std::vector<Vec3>& seeds,
                               std::int64_t seed, std::span<const std::int32_t> neighbours,
                               ConvexCell& result) {
  std::array<Vec3, 4> x;
  for (int k = 0; k < 4; ++k)
    x[k] = enlarged * (corners[k] - seeds[seed]);
  cell_->cell.init_tetrahedron(x[0][0], x[0][1], x[0][2], x[1][0], x[1][1], x[1][2], x[2][0], x[2][1],
                               x[2][2], x[3][0], x[3][1], x[3][2]);
  return cut(seeds, seed, neighbours, result);
}

bool VoroCell::cut(const std::vector<Vec3>& seeds, std::int64_t seed,
                   std::span<const std::int32_t> neighbours, ConvexCell& result) {
  auto& [cell, vertices, loops, labels] = *cell_;
  for (const std::int32_t j : neighbours) {
    const Vec3 apart = enlarged * (seeds[j] - seeds[seed]);
    // Voro++ measures in doubled coordinates: this is twice the cell's radius.
    if (apart.squaredNorm() > 1.000001 * cell.max_radius_squared())
      break;
    if (!cell.nplane(apart[0], apart[1], apart[2], j)) {
      result.clear();
      return false;
    }
  }
  cell.vertices(vertices);
  cell.face_vertices(loops);
  cell.neighbors(labels);
  result.clear();
  for (std::size_t v = 0; v + 2 < vertices.size(); v += 3)
    result.add_vertex(seeds[seed] + Vec3(vertices[v], vertices[v + 1], vertices[v + 2]) / enlarged);
  std::size_t at = 0;
  for (const int label : labels) {
    const auto size = static_cast<std::size_t>(loops[at]);
    std::reverse(loops.begin() + at + 1, loops.begin() + at + 1 + size); // Voro++ winds inward
    result.add_face(std::span(loops).subspan(at + 1, size), label);
    at += 1 + size;
  }
  return true;
}

} // namespace tessera::preprocess
