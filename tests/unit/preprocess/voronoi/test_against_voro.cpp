/// The cells of a box against those of an independent program: Voro++.
#include "preprocess/cloud/prepare.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>
#include <voro++/voro++.hh>

#include <cmath>

namespace tessera::preprocess {
namespace {

/// Cell volumes of points in a box, in the points' order.
std::vector<double> volumes_by_voro(const std::vector<Vec3>& X, const Vec3& upper) {
  // Voro++ takes no point that lies exactly on the far faces: its box is a hair larger.
  constexpr double hair = 1e-10;
  voro::container box(-hair, upper[0] + hair, -hair, upper[1] + hair, -hair, upper[2] + hair, 6, 6, 6, false,
                      false, false, 8);
  for (std::size_t i = 0; i < X.size(); ++i)
    box.put(static_cast<int>(i), X[i][0], X[i][1], X[i][2]);
  std::vector<double> volumes(X.size(), 0);
  voro::c_loop_all loop(box);
  voro::voronoicell cell;
  if (loop.start())
    do {
      if (box.compute_cell(cell, loop))
        volumes[static_cast<std::size_t>(loop.pid())] = cell.volume();
    } while (loop.inc());
  return volumes;
}

} // namespace

TEST(AgainstVoro, EveryVolumeAgrees) {
  // Particles that lie exactly on faces, edges and corners, as two-pass clouds have them, on a body of unit
  // size: Voro++ works with an absolute tolerance of 1e-11.
  const Vec3 upper(1, 1.2, 0.9);
  ParticleRequest request;
  request.arrangement = Arrangement::voronoi;
  request.count = 800;
  const auto cloud = prepare(test::box_domain(Vec3::Zero(), upper, 2), request, Progress::silent()).cloud;
  const std::vector<double> expected = volumes_by_voro(cloud.X, upper);
  const double mean = cloud.domain_volume / static_cast<double>(cloud.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(cloud.V[i] / mean, expected[i] / mean, 1e-8) << i;
}

} // namespace tessera::preprocess
