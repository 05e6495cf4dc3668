#include "core/tensor.hpp"

#include <gtest/gtest.h>

using namespace tessera;

namespace {

Mat3 sample() {
  Mat3 F;
  F << 1.1, 0.2, -0.3, 0.05, 0.9, 0.4, -0.1, 0.25, 1.3;
  return F;
}

} // namespace

TEST(Tensor, CofactorIsDeterminantTimesInverseTranspose) {
  const Mat3 F = sample();
  EXPECT_LT((cofactor(F) - F.determinant() * F.inverse().transpose()).norm(), 1e-14);
}

TEST(Tensor, CofactorIsHalfTheCrossProductWithItself) {
  const Mat3 F = sample();
  EXPECT_LT((0.5 * cross(F, F) - cofactor(F)).norm(), 1e-15);
}

TEST(Tensor, CrossProductIsSymmetricAndCrossWithIdentityIsTraceMinusTranspose) {
  const Mat3 F = sample(), I = Mat3::Identity();
  const Mat3 B = sample().transpose() * 2;
  EXPECT_LT((cross(F, B) - cross(B, F)).norm(), 1e-15);
  EXPECT_LT((cross(F, I) - (F.trace() * I - F.transpose())).norm(), 1e-15);
}

TEST(Tensor, CofactorOfASingularTensorIsFinite) {
  Mat3 F = Mat3::Zero();
  F(0, 0) = F(1, 1) = 1;
  Mat3 expected = Mat3::Zero();
  expected(2, 2) = 1;
  EXPECT_EQ(cofactor(F), expected);
}
