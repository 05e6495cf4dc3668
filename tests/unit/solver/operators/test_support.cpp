#include "solver/operators/support.hpp"

#include "core/error.hpp"
#include "solver/operators/gradient.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

TEST(Support, OnALatticeTheReferenceRadiusHolds32NeighboursInside) {
  const auto cloud = test::box_lattice(7, 7, 7, Vec3(1, 1, 1));
  const Neighbours graph = uniform_support(cloud.X, 2.2 * cloud.spacing);
  EXPECT_EQ(graph.count(171), 32); // 6 + 12 + 8 + 6 at distances 1, sqrt 2, sqrt 3, 2
}

TEST(Support, EveryParticleOfAnIrregularCloudHasEnoughNeighboursOfItsOwn) {
  const auto cloud = test::jittered(test::box_lattice(8, 8, 8, Vec3(1, 2, 1)), 0.3, 7);
  const Neighbours graph = adaptive_support<3>(cloud.X, cloud.V, 30);
  for (std::int64_t a = 0; a < graph.size(); ++a) {
    EXPECT_GE(graph.count(a), 30);
    EXPECT_LT(condition_number<3>(moment_matrix<3>(a, cloud.X, cloud.V, graph)), 1e3);
    for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e) {
      const auto first = graph.column.begin() + graph.row[graph.column[e]];
      const auto last = graph.column.begin() + graph.row[graph.column[e] + 1];
      EXPECT_TRUE(std::binary_search(first, last, static_cast<std::int32_t>(a)));
    }
  }
}

TEST(Support, IsConditionedForTheKernelItIsAskedFor) {
  const auto cloud = test::jittered(test::box_lattice(25, 21, 1, Vec3(1.2, 1, 0)), 0.5, 7);
  for (const std::string& name : kernel_names()) {
    const Kernel<2> kernel{kernel_named(name)};
    const Neighbours graph = adaptive_support<2>(cloud.X, cloud.V, 3, {}, kernel);
    for (std::int64_t a = 0; a < graph.size(); ++a)
      EXPECT_LT(condition_number<2>(moment_matrix<2>(a, cloud.X, cloud.V, graph, kernel)), 1e3) << name;
  }
}

TEST(Support, MoreNeighboursThanParticlesIsAnError) {
  const auto cloud = test::box_lattice(3, 3, 3, Vec3(1, 1, 1));
  EXPECT_THROW(adaptive_support<3>(cloud.X, cloud.V, 30), InputError);
}

TEST(Support, MoreNeighboursThanAParticleSeesIsAnErrorThatNamesIt) {
  const auto cloud = test::box_lattice(4, 4, 4, Vec3(1, 1, 1));
  std::vector<std::array<std::int32_t, 2>> pairs; // particle 5 sees twenty others only
  for (std::int32_t b = 6; b < 49; ++b)
    pairs.push_back({5, b});
  try {
    adaptive_support<3>(cloud.X, cloud.V, 30, HiddenPairs(cloud.size(), pairs));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("particle 5 "), std::string::npos) << e.what();
  }
}
