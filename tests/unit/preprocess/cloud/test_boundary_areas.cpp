#include "preprocess/cloud/boundary_areas.hpp"

#include "core/error.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera::preprocess {
namespace {

/// sum A and sum X (x) A, plainly.
std::pair<Vec3, Mat3> sums(const ParticleCloud& cloud) {
  std::pair<Vec3, Mat3> s{Vec3::Zero(), Mat3::Zero()};
  for (std::size_t i = 0; i < cloud.X.size(); ++i) {
    s.first += cloud.A[i];
    s.second += cloud.X[i] * cloud.A[i].transpose();
  }
  return s;
}

double volume(const ParticleCloud& cloud) {
  double sum = 0;
  for (const double V : cloud.V)
    sum += V;
  return sum;
}

ParticleCloud cloud_of(const Domain& domain, Arrangement arrangement) {
  ParticleRequest request;
  request.arrangement = arrangement;
  request.count = 700;
  return prepare(domain, request, Progress::silent()).cloud;
}

class BoundaryAreas : public testing::TestWithParam<Arrangement> {};
INSTANTIATE_TEST_SUITE_P(Arrangements, BoundaryAreas,
                         testing::Values(Arrangement::lattice, Arrangement::voronoi, Arrangement::poisson));

TEST_P(BoundaryAreas, IntegrateConstantsAndPositionsExactly) {
  const ParticleCloud cloud = cloud_of(test::l_domain(1, 2e-3, Vec3(0.01, -0.02, 0.03)), GetParam());
  const auto [A, XA] = sums(cloud);
  double area = 0, reach = 0;
  for (std::size_t i = 0; i < cloud.X.size(); ++i) {
    area += cloud.A[i].norm();
    reach = std::max(reach, cloud.X[i].norm());
  }
  EXPECT_LE(A.norm(), 1e-14 * area);
  EXPECT_LE((XA - volume(cloud) * Mat3::Identity()).norm(), 1e-13 * area * reach);
  EXPECT_LE(area_imbalance(cloud), 1e-13);
}

TEST(BalanceAreas, LeavesBalancedOnesAlone) {
  ParticleCloud cloud = cloud_of(test::box_domain(), Arrangement::lattice);
  const std::vector<Vec3> before = cloud.A;
  EXPECT_LE(balance_areas(cloud), 1e-14);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LE((cloud.A[i] - before[i]).norm(), 1e-15);
}

TEST(BalanceAreas, TheChangeIsTheSmallestInTheWeightedNorm) {
  // Any other change with the same sums differs by a null vector, to which the smallest one is orthogonal.
  ParticleCloud cloud = cloud_of(test::box_domain(), Arrangement::voronoi);
  for (std::size_t i = 0; i < cloud.A.size(); ++i)
    cloud.A[i] *= 1 + 0.1 * std::sin(double(i));
  const std::vector<Vec3> before = cloud.A;
  EXPECT_GT(balance_areas(cloud), 1e-3);
  std::vector<std::size_t> owning;
  for (std::size_t i = 0; i < before.size() && owning.size() < 5; ++i)
    if (before[i].norm() > 0)
      owning.push_back(i);
  // Five points carry an affine dependency: weights with sum zero and zero first moment.
  Eigen::Matrix<double, 4, 5> rows;
  for (int k = 0; k < 5; ++k)
    rows.col(k) << 1, cloud.X[owning[k]];
  const Eigen::Matrix<double, 5, 1> null = rows.fullPivLu().kernel().col(0);
  for (int c = 0; c < 3; ++c) {
    double product = 0, size = 0;
    for (int k = 0; k < 5; ++k) {
      const std::size_t i = owning[k];
      const double term = null[k] * (cloud.A[i][c] - before[i][c]) / before[i].norm();
      product += term;
      size += std::abs(term);
    }
    EXPECT_LE(std::abs(product), 1e-9 * size + 1e-12);
  }
}

TEST(BalanceAreas, OwnersInOnePlaneAreRefused) {
  ParticleCloud cloud;
  for (int i = 0; i < 6; ++i) {
    cloud.X.emplace_back(std::cos(i), std::sin(i), 0);
    cloud.V.push_back(1);
    cloud.A.emplace_back(0, 0, i % 2 ? 1 : -1);
  }
  EXPECT_THROW(balance_areas(cloud), InputError);
}

} // namespace
} // namespace tessera::preprocess
