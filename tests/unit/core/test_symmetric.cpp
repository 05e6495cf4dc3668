#include "core/symmetric.hpp"

#include <gtest/gtest.h>

using namespace tessera;

namespace {

const Symmetric A{1.5, -0.7, 2.1, 0.3, -0.4, 0.9}, B{0.2, 1.1, -0.6, 0.8, 0.5, -1.3};

Mat3 some_matrix() {
  Mat3 F;
  F << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  return F;
}

void expect_same(const Symmetric& found, const Mat3& expected) {
  EXPECT_LT((found.matrix() - expected).norm(), 2e-15);
}

} // namespace

TEST(Symmetric, AlgebraIsThatOfItsMatrices) {
  const Mat3 a = A.matrix(), b = B.matrix(), F = some_matrix();
  EXPECT_EQ(a, a.transpose());
  EXPECT_EQ(Symmetric::identity().matrix(), Mat3::Identity());
  expect_same(A + 2 * B, a + 2 * b);
  expect_same(add_isotropic(A, 3), a + 3 * Mat3::Identity());
  expect_same(deviator(A), a - a.trace() / 3 * Mat3::Identity());
  expect_same(square(A), a * a);
  expect_same(symmetric_product(F, F), F * F.transpose());
  expect_same(transform(F, A), F * a * F.transpose());
  EXPECT_LT((A * Vec3(1, -2, 3) - a * Vec3(1, -2, 3)).norm(), 2e-15);
  EXPECT_NEAR(inner(A, B), a.cwiseProduct(b).sum(), 2e-15);
  EXPECT_EQ(A.trace(), a.trace());
}

TEST(Symmetric, DeviatorOfNearlyEqualEntriesKeepsItsDigits) {
  const double small = 0x1p-40;
  EXPECT_EQ(deviator({1 + 3 * small, 1, 1, 0, 0, 0}), (Symmetric{2 * small, -small, -small, 0, 0, 0}));
}
