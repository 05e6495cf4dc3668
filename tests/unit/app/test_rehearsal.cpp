#include "app/rehearsal.hpp"

#include <gtest/gtest.h>

namespace tessera::app {
namespace {

Rehearsed run(std::int64_t particles, double finesse, double slowing) {
  Rehearsed r;
  r.particles = particles;
  r.finesse = finesse;
  r.slowing = slowing;
  return r;
}

TEST(Rehearsal, WithoutOneTheFirstStepStands) {
  EXPECT_EQ(expected_slowing({}, 10), 1);
}

TEST(Rehearsal, SlowingGrowsAlongALineFromTwoParticlesAnEdge) {
  EXPECT_NEAR(expected_slowing({run(125, 5, 2.5)}, 5), 2.5, 1e-12);
  EXPECT_NEAR(expected_slowing({run(125, 5, 2.5)}, 20), 10, 1e-12);
  EXPECT_NEAR(expected_slowing({run(125, 5, 2.5), run(1000, 10, 5)}, 20), 10, 1e-12);
}

TEST(Rehearsal, BetweenRunsThatDisagreeItIsTheLineOfLeastSquares) {
  // (2, 1), (4, 3), (6, 2): mean (4, 2), slope 1/4.
  EXPECT_NEAR(expected_slowing({run(64, 4, 3), run(216, 6, 2)}, 12), 4, 1e-12);
}

TEST(Rehearsal, NoRunTakesFewerStepsThanTheFirstOneWouldMake) {
  EXPECT_EQ(expected_slowing({run(125, 5, 3), run(1000, 10, 1)}, 50), 1);
}

} // namespace
} // namespace tessera::app
