#include "preprocess/seeding/random.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera::preprocess {
namespace {

TEST(RandomPoints, AreUniformAndTheSameEverywhere) {
  const Domain ell = test::l_domain(2);
  RandomPoints random(ell, 42), again(ell, 42);
  constexpr int n = 30000;
  int in_corner = 0;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < n; ++i) {
    const Vec3 X = random.next();
    ASSERT_EQ(X, again.next());
    ASSERT_TRUE((X.array() >= 0).all() && X.x() <= 2 && X.y() <= 2 && X.z() <= 1 &&
                (X.x() <= 1 || X.y() <= 1));
    in_corner += X.x() < 1 && X.y() < 1;
    mean += X / n;
  }
  EXPECT_NEAR(in_corner / double{n}, 1. / 3, 0.012);
  EXPECT_LE((mean - Vec3(5. / 6, 5. / 6, 0.5)).norm(), 0.015);
}

/// A density that falls with x: size^-3 = 1 / (1 + x)^3.
double rising(const Vec3& X) {
  return (1 + X.x()) / 3;
}

TEST(RandomPoints, FollowASizeField) {
  // Two large tetrahedra a side: the field varies much inside each.
  const Domain ell = test::l_domain(1);
  RandomPoints random(ell, 7, rising), again(ell, 7, rising);
  constexpr int n = 20000;
  int low = 0;
  for (int i = 0; i < n; ++i) {
    const Vec3 X = random.next();
    ASSERT_EQ(X, again.next());
    low += X.x() < 1;
  }
  // Twice as high up to x = 1 as beyond: 2 (1 - 1/4)/2 against (1/4 - 1/9)/2.
  const double below = 3. / 4, beyond = 5. / 72;
  EXPECT_NEAR(low / double{n}, below / (below + beyond), 0.006);
  EXPECT_NEAR(graded_volume(ell, rising), 27 * (below + beyond), 0.002 * 27 * (below + beyond));
}

TEST(RandomPoints, OfASlabLieInItsPlane) {
  const Domain slab = test::l_slab(2);
  RandomPoints random(slab, 7), graded(slab, 7, rising);
  constexpr int n = 20000;
  int low = 0, graded_low = 0;
  for (int i = 0; i < n; ++i) {
    const Vec3 X = random.next(), Y = graded.next();
    ASSERT_EQ(X.z(), 0);
    ASSERT_EQ(Y.z(), 0);
    low += X.x() < 1;
    graded_low += Y.x() < 1;
  }
  EXPECT_NEAR(low / double{n}, 2. / 3, 0.012);
  const double below = 1, beyond = 1. / 6; // size^-2 in the plane
  EXPECT_NEAR(graded_low / double{n}, below / (below + beyond), 0.01);
  EXPECT_NEAR(graded_volume(slab, rising), 9 * (below + beyond), 0.002 * 9 * (below + beyond));
}

} // namespace
} // namespace tessera::preprocess
