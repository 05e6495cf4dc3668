#include "solver/time/momentum_projection.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace tessera;
using namespace tessera::solver;

namespace {

template <int D>
struct Forces {
  std::vector<Vec<D>> R, x;
  std::vector<double> V;

  explicit Forces(const Vec<D>& offset) {
    std::mt19937_64 random(9);
    const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
    for (int a = 0; a < 3000; ++a) {
      Vec<D> r, position;
      for (int c = 0; c < D; ++c) {
        r[c] = number() + 0.3;
        position[c] = number();
      }
      R.push_back(r);
      x.push_back(position + offset);
      V.push_back(1.5 + number());
    }
  }

  Vec<D> force() const {
    Vec<D> total = Vec<D>::Zero();
    for (std::size_t a = 0; a < R.size(); ++a)
      total += V[a] * R[a];
    return total;
  }
};

Vec3 moment(const Forces<3>& f) {
  Vec3 total = Vec3::Zero();
  for (std::size_t a = 0; a < f.R.size(); ++a)
    total += f.V[a] * f.x[a].cross(f.R[a]);
  return total;
}

double moment(const Forces<2>& f) {
  double total = 0;
  for (std::size_t a = 0; a < f.R.size(); ++a)
    total += f.V[a] * (f.x[a][0] * f.R[a][1] - f.x[a][1] * f.R[a][0]);
  return total;
}

} // namespace

TEST(MomentumProjection, BalancesForcesAndMomentsInSpace) {
  Forces<3> f(Vec3(10, -5, 2));
  project_momentum<3>(f.R, f.x, f.V);
  EXPECT_LT(f.force().norm(), 1e-10);
  EXPECT_LT(moment(f).norm(), 1e-9);
}

TEST(MomentumProjection, BalancesForcesAndMomentsInThePlane) {
  Forces<2> f(Vec<2>(10, -5));
  project_momentum<2>(f.R, f.x, f.V);
  EXPECT_LT(f.force().norm(), 1e-10);
  EXPECT_LT(std::abs(moment(f)), 1e-9);
}

TEST(MomentumProjection, LeavesBalancedForcesAlone) {
  Forces<3> f(Vec3::Zero());
  project_momentum<3>(f.R, f.x, f.V);
  const auto once = f.R;
  project_momentum<3>(f.R, f.x, f.V);
  for (std::size_t a = 0; a < once.size(); ++a)
    EXPECT_LT((f.R[a] - once[a]).norm(), 1e-14);
}
