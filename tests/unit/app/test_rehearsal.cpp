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

TEST(Rehearsal, OneRunIsTakenAsItIs) {
  EXPECT_DOUBLE_EQ(expected_slowing({run(100, 4.6, 1.7)}, 20), 1.7);
}

TEST(Rehearsal, SlowingGrowsAlongALine) {
  EXPECT_NEAR(expected_slowing({run(125, 5, 2), run(1000, 10, 4)}, 20), 8, 1e-12);
  EXPECT_NEAR(expected_slowing({run(125, 5, 2), run(343, 7, 2.8), run(1000, 10, 4)}, 20), 8, 1e-12);
}

TEST(Rehearsal, NoRunTakesFewerStepsThanTheFirstOneWouldMake) {
  EXPECT_EQ(expected_slowing({run(125, 5, 1.2), run(1000, 10, 1.05)}, 30), 1);
}

} // namespace
} // namespace tessera::app
