#include "solver/boundary/fixed.hpp"

#include <gtest/gtest.h>

using namespace tessera;
using namespace tessera::solver;

TEST(Fixed, HoldsTheNamedComponentsOfItsSetOnly) {
  std::vector<Vec3> p(3, Vec3(1, 2, 3));
  Fixed<3>{{0, 2}, {true, false, true}}.apply(p);
  EXPECT_EQ(p[0], Vec3(0, 2, 0));
  EXPECT_EQ(p[1], Vec3(1, 2, 3));
  EXPECT_EQ(p[2], Vec3(0, 2, 0));
}
