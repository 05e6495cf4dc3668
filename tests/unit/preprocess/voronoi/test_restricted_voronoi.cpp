#include "core/error.hpp"
#include "preprocess/geometry/boundary.hpp"
#include "preprocess/voronoi/merge.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/tessellation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::preprocess {
namespace {

using test::random_points;
using test::Tessellation;

/// Two blocks joined at their foot, a slot of the given width between them: volume 4 + width.
Domain slotted_domain(double width) {
  Domain domain;
  const std::array<double, 4> x{0, 1, 1 + width, 2 + width};
  const auto number = [](int i, int j, int k) { return i + 4 * (j + 3 * k); };
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i)
        domain.vertices.emplace_back(x[i], j, k);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) {
      if (i == 1 && j == 1)
        continue;
      std::array<int, 3> order{0, 1, 2};
      do {
        std::array<int, 3> p{i, j, 0};
        std::array<std::int32_t, 4> tet{number(i, j, 0), 0, 0, 0};
        for (int step = 0; step < 3; ++step) {
          ++p[order[step]];
          tet[step + 1] = number(p[0], p[1], p[2]);
        }
        domain.tets.push_back(tet);
        if (domain.tet_volume(domain.tets.size() - 1) < 0)
          std::swap(domain.tets.back()[2], domain.tets.back()[3]);
      } while (std::next_permutation(order.begin(), order.end()));
    }
  domain.facets = boundary_of(domain.tets);
  for (auto& facet : domain.facets)
    facet.surface = 0;
  domain.surfaces = {"skin"};
  domain.measure();
  domain.cad_volume = domain.volume;
  return domain;
}

TEST(RestrictedVoronoi, AgreesCellByCellWithCuttingEveryTetrahedronByEveryBisector) {
  const Domain ell = test::l_domain(2);
  const Tessellation t(ell, random_points(ell, 60));
  const CellMeasures measures = measure_cells(t.voronoi);
  for (std::size_t i = 0; i < t.seeds.size(); ++i) {
    double volume = 0;
    Vec3 moment = Vec3::Zero(), area = Vec3::Zero();
    for (std::size_t k = 0; k < t.domain.tets.size(); ++k) {
      const auto& tet = t.domain.tets[k];
      ConvexCell cell;
      cell.set_tetrahedron(t.body.points[tet[0]], t.body.points[tet[1]], t.body.points[tet[2]],
                           t.body.points[tet[3]]);
      for (std::size_t j = 0; j < t.seeds.size() && !cell.empty(); ++j)
        if (j != i)
          cell.clip(t.seeds[j] - t.seeds[i], (t.seeds[i] + t.seeds[j]) / 2, static_cast<std::int32_t>(j));
      const auto m = cell.measure(t.seeds[i]);
      volume += m.volume;
      moment += m.moment;
      for (const auto& face : cell.faces())
        if (face.label < 0 && t.body.across[k][-1 - face.label] < 0)
          area += cell.area(face);
    }
    EXPECT_NEAR(measures.volume[i], volume, 1e-13);
    EXPECT_LE((measures.moment[i] - moment).norm(), 1e-13);
    Vec3 shared = Vec3::Zero();
    for (const auto& share : measures.shares[i])
      shared += share.area;
    EXPECT_LE((shared - area).norm(), 1e-12);
  }
}

TEST(RestrictedVoronoi, RandomPointsFallIntoCellsByTheirVolume) {
  const Domain ell = test::l_domain(1);
  const Tessellation t(ell, random_points(ell, 12));
  const CellMeasures measures = measure_cells(t.voronoi);
  constexpr int samples = 200000;
  std::vector<int> hits(t.seeds.size(), 0);
  RandomPoints random(ell, 99);
  for (int s = 0; s < samples; ++s) {
    const Vec3 x = t.body.scaling.in(random.next());
    const auto nearest = std::min_element(t.seeds.begin(), t.seeds.end(), [&](const Vec3& a, const Vec3& b) {
      return (a - x).squaredNorm() < (b - x).squaredNorm();
    });
    ++hits[nearest - t.seeds.begin()];
  }
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double p = t.volume(measures.volume[i]) / ell.volume;
    EXPECT_NEAR(hits[i] / double{samples}, p, 5 * std::sqrt(p * (1 - p) / samples));
  }
}

TEST(RestrictedVoronoi, OneAndTwoSeedsTessellateTheBody) {
  const Domain box = test::box_domain();
  for (const int count : {1, 2, 3, 4}) {
    const Tessellation t(box, random_points(box, count));
    const CellMeasures measures = measure_cells(t.voronoi);
    double sum = 0;
    for (const double v : measures.volume)
      sum += t.volume(v);
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(RestrictedVoronoi, CellsThatTouchTheBoundaryInALineAreKept) {
  // A cell of the square lattice turned by 45 degrees whose corner lies on the re-entrant edge x = y = 1.
  const Domain ell = test::l_domain(2);
  std::vector<Vec3> X;
  for (int j = -20; j <= 20; ++j)
    for (int i = -20; i <= 20; ++i) {
      const Vec3 x(1 + 0.25 * (i - j), 1 - 0.25 * (i + j + 1), 0.5);
      if (x.x() > 0 && x.y() > 0 && x.x() < 2 && x.y() < 2 && (x.x() < 1 || x.y() < 1))
        X.push_back(x);
    }
  ASSERT_GT(X.size(), 10u);
  for (const Backend backend : {Backend::clipper, Backend::voro}) {
    const Tessellation t(ell, X);
    const CellMeasures measures = measure_cells(RestrictedVoronoi(t.body, t.seeds, t.graph, backend));
    double sum = 0;
    for (const double v : measures.volume)
      sum += t.volume(v);
    EXPECT_NEAR(sum, 3, 1e-12);
  }
}

TEST(RestrictedVoronoi, MaterialAcrossASlotGoesToItsOwnSide) {
  const Domain domain = slotted_domain(0.02);
  const Tessellation t(domain, random_points(domain, 400));
  const CellMeasures measures = measure_cells(t.voronoi);
  EXPECT_GT(measures.disconnected, 0);
  double sum = 0;
  std::vector<Vec3> centroids;
  for (std::size_t i = 0; i < t.seeds.size(); ++i) {
    sum += t.volume(measures.volume[i]);
    centroids.push_back(t.body.scaling.out(t.seeds[i] + measures.moment[i] / measures.volume[i]));
  }
  EXPECT_NEAR(sum, domain.volume, 1e-12);
  const auto side = [](const Vec3& X) { return X.y() < 1 ? 0 : X.x() < 1.01 ? -1 : 1; };
  for (const auto& orphan : measures.orphans) {
    EXPECT_NE(orphan.cell, orphan.receiver);
    const Vec3 from = t.body.scaling.out(t.seeds[orphan.cell]),
               to = t.body.scaling.out(t.seeds[orphan.receiver]);
    EXPECT_LE(side(from) * side(to), 0) << "handed to its own side of the slot";
  }
  // Above the slot's foot, cells that own only their side have their centroid in it.
  for (std::size_t i = 0; i < t.seeds.size(); ++i) {
    const Vec3 X = t.body.scaling.out(t.seeds[i]);
    if (X.y() > 1.4) {
      EXPECT_EQ(side(centroids[i]), side(X)) << i;
    }
  }
}

TEST(Delaunay, RefusesPointsThatCoincide) {
  EXPECT_THROW(delaunay_graph({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)}), InputError);
}

TEST(Delaunay, NearestNeighbourComesFirstAlsoOnAFlatSet) {
  const DelaunayGraph graph = delaunay_graph({Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 1, 0), Vec3(4, 4, 0)});
  EXPECT_EQ(graph.of(0)[0], 2);
  EXPECT_EQ(graph.of(3)[0], 1);
}

TEST(TetBody, NamesAPlaceWhereBoundaryAndTetrahedraDisagree) {
  Domain box = test::box_domain();
  box.facets.pop_back();
  EXPECT_THROW(TetBody(box, scaling_for(box, 0.1)), InputError);
}

TEST(CellVertices, AreEquallyFarFromTheirSeedsAndOnTheirSurfaces) {
  const Domain ell = test::l_domain(2);
  const Tessellation t(ell, random_points(ell, 300));
  const PlacedPoints points = cell_vertices(t.voronoi);
  EXPECT_GT(points.size(), 5.5 * 300);
  int last_dimension = 0;
  std::array<int, 4> by_dimension{};
  for (std::int64_t k = 0; k < points.size(); ++k) {
    const auto& place = points.place[k];
    EXPECT_GE(place.dimension, last_dimension);
    last_dimension = place.dimension;
    ++by_dimension[place.dimension];
    std::vector<double> distances;
    for (const Vec3& seed : t.seeds)
      distances.push_back((seed - points.X[k]).norm());
    std::sort(distances.begin(), distances.end());
    // A vertex on a place of dimension d has d + 1 nearest seeds.
    EXPECT_LE(distances[place.dimension] - distances[0], 1e-12) << k;
    if (place.dimension == 2) {
      double off = 1;
      for (const auto& facet : ell.facets) {
        if (facet.surface != place.entity)
          continue;
        const Vec3& a = t.body.points[facet.vertices[0]];
        const Vec3 normal =
            (t.body.points[facet.vertices[1]] - a).cross(t.body.points[facet.vertices[2]] - a);
        off = std::min(off, std::abs(normal.normalized().dot(points.X[k] - a)));
      }
      EXPECT_LE(off, 1e-13);
    }
  }
  EXPECT_EQ(by_dimension[0], 12);
  for (const int count : by_dimension)
    EXPECT_GT(count, 0);
}

TEST(CellVertices, NoVertexIsFoundTwice) {
  const Domain ell = test::l_domain(3);
  const Tessellation t(ell, random_points(ell, 500));
  const CadTopology cad(t.domain);
  const PlacedPoints points = cell_vertices(t.voronoi);
  EXPECT_EQ(merged(points, cad, 0).size(), points.size());
}

TEST(Merge, LowerDimensionsWinAndPlatesKeepBothSides) {
  const Domain plate = test::box_domain(Vec3::Zero(), Vec3(10, 10, 0.1), 1);
  const CadTopology cad(plate);
  const auto surface = [&](const char* name) {
    const auto at = std::find(plate.surfaces.begin(), plate.surfaces.end(), name);
    return CadPlace{2, static_cast<std::int32_t>(at - plate.surfaces.begin())};
  };
  PlacedPoints points;
  for (const std::int32_t v : plate.corners)
    points.add(plate.vertices[v], {0, v});
  points.add(Vec3(5, 5, 0), surface("zmin"));
  points.add(Vec3(5, 5, 0.1), surface("zmax"));   // the other side of the plate: stays
  points.add(Vec3(5.2, 5, 0.1), surface("zmax")); // yields to the one before
  points.add(Vec3(0.2, 0, 0), surface("zmin"));   // yields to a corner
  points.add(Vec3(5, 5.3, 0.05), {});             // yields to both faces
  points.add(Vec3(8, 8, 0.05), {});
  const PlacedPoints kept = merged(points, cad, 0.5);
  ASSERT_EQ(kept.size(), 8 + 3); // four pairs of corners 0.1 apart stay, too
  EXPECT_EQ(kept.X[8], Vec3(5, 5, 0));
  EXPECT_EQ(kept.X[9], Vec3(5, 5, 0.1));
  EXPECT_EQ(kept.X[10], Vec3(8, 8, 0.05));
}

} // namespace
} // namespace tessera::preprocess
