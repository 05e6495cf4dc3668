/// The scheme "consistent" on the swinging cube, a standing pressure wave with a closed form: second order on
/// lattices, irregular clouds and two-pass clouds, where the thesis' scheme does not converge.
#include "preprocess/cloud/boundary_areas.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/operators/support.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/swinging_cube.hpp"
#include "tests/support/tessellation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace tessera;
using namespace tessera::solver;

namespace {

double velocity_error(const ParticleCloud& cloud, const std::string& scheme,
                      const std::string& dissipation = "auto") {
  SceneSpec scene = test::swinging_cube(scheme);
  scene.dissipation = dissipation;
  return run(scene, cloud, {}, Progress::silent()).error->l2_velocity_relative;
}

ParticleCloud lattice(int n) {
  return test::box_lattice(n, n, n, Vec3::Ones());
}

/// Inner particles moved by up to 0.3 spacings, each with its exact Voronoi cell.
ParticleCloud irregular(int n) {
  ParticleCloud cloud = test::jittered(lattice(n), 0.3, 1);
  const test::Tessellation cells(test::box_domain(), cloud.X);
  const preprocess::CellMeasures measures = preprocess::measure_cells(cells.voronoi);
  preprocess::Shares shares = measures.shares;
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    cloud.V[a] = cells.volume(measures.volume[a]);
    for (preprocess::SurfaceShare& share : shares[a])
      share.area *= cells.body.scaling.area();
  }
  preprocess::balance_areas(cells.domain, cloud, shares);
  for (ParticleSet& set : cloud.sets)
    set.area.assign(set.area.size(), Vec3::Zero());
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    for (const preprocess::SurfaceShare& share : shares[a]) {
      const std::string& surface = cells.domain.surfaces[share.surface]; // "xmin"
      const std::string name = fmt::format("{}_{}", surface[0], surface.substr(1));
      for (ParticleSet& set : cloud.sets)
        if (set.name == name) {
          const auto at = std::find(set.particles.begin(), set.particles.end(), static_cast<std::int32_t>(a));
          set.area.at(static_cast<std::size_t>(at - set.particles.begin())) = share.area;
        }
    }
  return cloud;
}

void second_order(double coarse, double fine, double at_most) {
  EXPECT_LT(fine, at_most);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " and " << fine;
}

} // namespace

TEST(SecondOrder, OnALattice) {
  second_order(velocity_error(lattice(9), "consistent"), velocity_error(lattice(17), "consistent"), 0.0032);
}

TEST(SecondOrder, OnALatticeWithSymmetricJst) {
  second_order(velocity_error(lattice(9), "consistent", "jst_symmetric"),
               velocity_error(lattice(17), "consistent", "jst_symmetric"), 0.0032);
}

TEST(SecondOrder, OnAnIrregularCloudWhereTheThesisDoesNotConverge) {
  const ParticleCloud coarse = irregular(9), fine = irregular(17);
  second_order(velocity_error(coarse, "consistent"), velocity_error(fine, "consistent"), 0.009);
  EXPECT_GT(velocity_error(coarse, "thesis"), 0.2);
}

TEST(SecondOrder, OperatorsOfTwoPassCloudsBalanceAConstantStress) {
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = 1500;
  const ParticleCloud cloud = preprocess::prepare(test::l_domain(), request, Progress::silent()).cloud;
  const Neighbours graph = adaptive_support<3>(cloud.X, cloud.V, 30, cloud.hidden);
  Gradient<3> gradient = build_gradient<3>(cloud.X, cloud.V, graph);
  balance_constant_stress<3>(gradient, cloud.X, cloud.V, cloud.A, graph);
  double surface = 0;
  for (const Vec3& A : cloud.A)
    surface = std::max(surface, A.norm());
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    Vec3 force = gradient.s[a];
    Mat3 slope = -cloud.X[a] * gradient.s[a].transpose();
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      force += gradient.t[e];
      slope += cloud.X[graph.column[e]] * gradient.w[e].transpose();
    }
    ASSERT_LT((cloud.V[a] * force + cloud.A[a]).norm(), 1e-12 * surface) << a;
    ASSERT_LT((slope - Mat3::Identity()).norm(), 1e-11) << a;
  }
}
