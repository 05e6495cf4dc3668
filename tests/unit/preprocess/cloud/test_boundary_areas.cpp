#include "preprocess/cloud/boundary_areas.hpp"

#include "core/error.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

/// A cloud with its surfaces as sets, and shares anew from them.
struct Unbalanced {
  Domain domain;
  ParticleCloud cloud;
  Shares shares;

  Unbalanced(const Domain& body, Arrangement arrangement) : domain(body), cloud(cloud_of(body, arrangement)) {
    shares.resize(cloud.X.size());
    for (std::size_t s = 0; s < domain.surfaces.size(); ++s) {
      const ParticleSet& set = cloud.set(domain.surfaces[s]);
      for (std::size_t k = 0; k < set.particles.size(); ++k)
        shares[set.particles[k]].push_back({static_cast<std::int32_t>(s), set.area[k]});
    }
  }
};

TEST(BalanceAreas, LeavesBalancedOnesAlone) {
  Unbalanced body(test::box_domain(), Arrangement::poisson);
  const std::vector<Vec3> before = body.cloud.A;
  EXPECT_LE(balance_areas(body.domain, body.cloud, body.shares), 1e-13);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LE((body.cloud.A[i] - before[i]).norm(), 1e-15);
}

TEST(BalanceAreas, TheChangeOfAFlatSurfaceIsTheSmallestAlongItsNormal) {
  // Any other change with the same sums differs by a null vector, to which the smallest one is orthogonal.
  Unbalanced body(test::box_domain(), Arrangement::voronoi);
  for (std::size_t i = 0; i < body.shares.size(); ++i)
    for (SurfaceShare& share : body.shares[i])
      share.area *= 1 + 0.1 * std::sin(double(i));
  const Shares before = body.shares;
  EXPECT_GT(balance_areas(body.domain, body.cloud, body.shares), 1e-3);
  const ParticleSet& top = body.cloud.set("zmax");
  constexpr int few =
      4; // points of a plane carry an affine dependency: weights of no sum and no first moment
  Eigen::Matrix<double, 3, few> rows;
  std::array<Vec3, few> change;
  std::array<double, few> weight;
  int found = 0;
  for (std::size_t k = 0; k < top.particles.size() && found < few; k += 3) {
    const auto i = static_cast<std::size_t>(top.particles[k]);
    for (std::size_t j = 0; j < before[i].size(); ++j)
      if (body.domain.surfaces[before[i][j].surface] == "zmax" && before[i][j].area.z() > 0) {
        change[found] = body.shares[i][j].area - before[i][j].area;
        weight[found] = before[i][j].area.z();
        rows.col(found++) << 1, body.cloud.X[i].head<2>();
      }
  }
  ASSERT_EQ(found, few);
  const Eigen::Matrix<double, few, 1> null = rows.fullPivLu().kernel().col(0);
  double product = 0, size = 0;
  for (int k = 0; k < few; ++k) {
    EXPECT_EQ(change[k].head<2>(), Vec<2>::Zero());
    product += null[k] * change[k].z() / weight[k];
    size += std::abs(null[k] * change[k].z() / weight[k]);
  }
  EXPECT_LE(std::abs(product), 1e-9 * size);
}

TEST(SurfaceMembers, TakeWhatOthersOwnByVolumeAndNearness) {
  ParticleCloud cloud;
  cloud.dimension = 2;
  cloud.spacing = 1;
  cloud.X = {Vec3(0, 0, 0), Vec3(1, 0, 0),  Vec3(2, 0, 0), Vec3(3, 0, 0),
             Vec3(4, 0, 0), Vec3(50, 0, 0), Vec3(1, 1, 0)};
  cloud.V = {1, 0.1, 2, 1, 1, 1, 1};
  Shares shares(7);
  shares[0] = {{0, Vec3(0, -1, 0)}};
  shares[1] = {{1, Vec3(5, 0, 0)}};
  shares[6] = {{0, Vec3(0, -2, 0)}, {1, Vec3(3, 0, 0)}};
  gather_on_members(cloud, {{0, 1, 2, 3, 4, 5}, {}}, shares);
  // Of the five nearest, at sqrt(2), 1, sqrt(2), sqrt(5) and sqrt(10), the last has no weight.
  const double reach = std::sqrt(10), weight[] = {1 - std::sqrt(2) / reach, 0.1 * (1 - 1 / reach),
                                                  2 * (1 - std::sqrt(2) / reach), 1 - std::sqrt(5) / reach};
  const double total = weight[0] + weight[1] + weight[2] + weight[3];
  EXPECT_NEAR(shares[0][0].area.y(), -1 - 2 * weight[0] / total, 1e-8);
  EXPECT_NEAR(shares[1][0].area.y(), -2 * weight[1] / total, 1e-8);
  EXPECT_EQ(shares[1][1].area, Vec3(5, 0, 0));
  EXPECT_NEAR(shares[2][0].area.y(), -2 * weight[2] / total, 1e-8);
  EXPECT_NEAR(shares[3][0].area.y(), -2 * weight[3] / total, 1e-8);
  EXPECT_NEAR(shares[4][0].area.y(), 0, 1e-8);
  EXPECT_TRUE(shares[5].empty());
  ASSERT_EQ(shares[6].size(), 1u); // nobody else stands for the other surface
  EXPECT_EQ(shares[6][0].area, Vec3(3, 0, 0));
}

TEST(BalanceAreas, SetsAreThePartsAndFlatOnesKeepTheirNormals) {
  for (const Domain& domain : {test::l_domain(), test::holed_domain(3), test::l_slab(), test::holed_slab(3)})
    for (const Arrangement arrangement : {Arrangement::voronoi, Arrangement::poisson}) {
      const Unbalanced body(domain, arrangement);
      const ParticleCloud& cloud = body.cloud;
      std::vector<Vec3> parts(cloud.X.size(), Vec3::Zero());
      for (const std::string& name : domain.surfaces) {
        const ParticleSet& set = cloud.set(name);
        Vec3 total = Vec3::Zero();
        double size = 0;
        for (const Vec3& A : set.area) {
          total += A;
          size += A.norm();
        }
        const bool flat = total.norm() > 0.999 * size; // the hole is not
        for (std::size_t k = 0; k < set.particles.size(); ++k) {
          parts[set.particles[k]] += set.area[k];
          if (flat) {
            EXPECT_LE(set.area[k].cross(total).norm(), 1e-15 * set.area[k].norm() * total.norm()) << name;
            EXPECT_GE(set.area[k].dot(total), 0) << name;
          }
        }
      }
      for (std::size_t i = 0; i < parts.size(); ++i)
        EXPECT_LE((parts[i] - cloud.A[i]).norm(), 1e-15 * cloud.A[i].norm()) << i;
      EXPECT_LE(area_imbalance(cloud), 1e-13);
    }
}

TEST(BalanceAreas, UniformLoadsHaveTheirExactResultantAndMomentOnEverySurface) {
  for (const Domain& domain :
       {test::l_domain(), test::holed_domain(3), test::l_slab(), test::holed_slab(3)}) {
    const Unbalanced body(domain, Arrangement::voronoi);
    for (std::size_t s = 0; s < domain.surfaces.size(); ++s) {
      Vec3 resultant = Vec3::Zero();
      Mat3 moment = Mat3::Zero();
      double scale = 0;
      for (const auto& facet : domain.facets)
        if (facet.surface == static_cast<std::int32_t>(s)) {
          const Vec3 &a = domain.vertices[facet.vertices[0]], &b = domain.vertices[facet.vertices[1]],
                     &c = domain.vertices[facet.vertices[2]];
          const Vec3 area = (b - a).cross(c - a) / 2;
          resultant += area;
          moment += (a + b + c) / 3 * area.transpose();
          scale += area.norm();
        }
      if (domain.dimension == 2)
        moment.row(2).setZero();
      const ParticleSet& set = body.cloud.set(domain.surfaces[s]);
      for (std::size_t k = 0; k < set.particles.size(); ++k) {
        resultant -= set.area[k];
        moment -= body.cloud.X[set.particles[k]] * set.area[k].transpose();
      }
      EXPECT_LE(resultant.norm(), 1e-14 * scale) << domain.surfaces[s];
      EXPECT_LE(moment.norm(), 1e-14 * scale) << domain.surfaces[s];
    }
  }
}

TEST(BalanceAreas, OwnersInOnePlaneAreRefused) {
  const Domain domain = test::box_domain();
  ParticleCloud cloud;
  Shares shares;
  for (int i = 0; i < 6; ++i) {
    cloud.X.emplace_back(std::cos(i), std::sin(i), 0);
    cloud.V.push_back(1);
    shares.push_back({{i, Vec3(0, 0, i % 2 ? 1 : -1)}});
  }
  EXPECT_THROW(balance_areas(domain, cloud, shares), InputError);
}

} // namespace
} // namespace tessera::preprocess
