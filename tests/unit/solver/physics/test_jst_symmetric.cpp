#include "solver/physics/jst_symmetric.hpp"

#include "tests/unit/solver/physics/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

template <class T>
class SymmetricJst : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SymmetricJst, Dimensions);

template <int D>
ParticleCloud irregular_block() {
  return test::jittered(D == 3 ? test::box_lattice(6, 7, 6, Vec3(0.5, 0.6, 0.5))
                               : test::box_lattice(9, 11, 1, Vec3(0.8, 1, 0)),
                        0.3, 9);
}

double number(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

/// Momenta at random, and waves of different speeds in different places.
template <class Body>
void stir(Body& body) {
  std::mt19937_64 random(4);
  for (auto& p : body.U.p)
    for (double& component : p)
      component = 1000 * number(random);
  for (double& c : body.wave)
    c = 100 * (2 + number(random));
  body.dissipation.advance(body);
}

} // namespace

TYPED_TEST(SymmetricJst, TakesTheEnergyOfTheLaplacianAndConservesMomentum) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  auto body = make_body<PF<D>>(cloud, JstSymmetric<D>{});
  stir(body);
  body.rates(); // at rest: all of dp/dt is dissipation
  const Laplacian& lap = body.dissipation.laplacian;
  Vec<D> total = Vec<D>::Zero();
  double power = 0, energy = 0, scale = 0;
  for (std::int64_t a = 0; a < body.size(); ++a) {
    Vec<D> lap_p = -lap.sum[a] * body.U.p[a];
    for (std::int64_t e = body.neighbours.row[a]; e < body.neighbours.row[a + 1]; ++e)
      lap_p += lap.l[e] * body.U.p[body.neighbours.column[e]];
    const double length = std::pow(body.V[a], 1.0 / D);
    energy += body.V[a] * body.wave[a] / 8 * std::pow(length, 3) * lap_p.squaredNorm();
    power += body.V[a] * body.U.p[a].dot(body.R.p[a]);
    total += body.V[a] * body.R.p[a];
    scale += body.V[a] * body.R.p[a].norm();
  }
  EXPECT_NEAR(power / -energy, 1, 1e-12);
  EXPECT_LT(total.norm(), 1e-12 * scale);
}

TYPED_TEST(SymmetricJst, SparesLinearMomenta) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  auto body = make_body<PF<D>>(cloud, JstSymmetric<D>{});
  stir(body);
  body.rates();
  double rough = 0;
  for (const auto& force : body.R.p)
    rough = std::max(rough, force.norm());
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    body.U.p[a] = Vec<D>::Constant(700) + 900 * cloud.X[a].head<D>().reverse();
  body.rates();
  for (const auto& force : body.R.p)
    EXPECT_LT(force.norm(), 1e-11 * rough);
}

TYPED_TEST(SymmetricJst, IsTheThesisJstInsideALattice) {
  // There the Laplacian is symmetric, and all lengths are one.
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud =
      D == 3 ? test::box_lattice(13, 13, 13, Vec3::Ones()) : test::box_lattice(13, 13, 1, Vec3(1, 1, 0));
  Jst<D> thesis;
  thesis.delta = cloud.spacing;
  auto body = make_body<PF<D>>(cloud, JstSymmetric<D>{}), other = make_body<PF<D>>(cloud, thesis);
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    body.U.p[a] = other.U.p[a] = stirred(cloud.X[a]).template head<D>();
  body.rates();
  other.rates();
  int inside = 0;
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    const Vec3 from_middle = cloud.X[a] - (D == 3 ? Vec3(0.5, 0.5, 0.5) : Vec3(0.5, 0.5, 0));
    if (from_middle.cwiseAbs().maxCoeff() >
        0.11) // what is nearer to the faces than two supports sees their cells
      continue;
    ++inside;
    EXPECT_LT((body.R.p[a] - other.R.p[a]).norm(), 1e-9 * other.R.p[a].norm()) << a;
  }
  EXPECT_EQ(inside, D == 3 ? 27 : 9);
}

TYPED_TEST(SymmetricJst, OfTheVolumeMapKeepsItsSumAndTakesItsRoughness) {
  constexpr int D = TypeParam::value;
  const ParticleCloud cloud = irregular_block<D>();
  JstSymmetric<D, true> dissipation;
  dissipation.kappa4_J = 0.25;
  auto body = make_body<PFJ<D>>(cloud, dissipation);
  std::mt19937_64 random(8);
  for (double& J : body.U.J)
    J = 1 + 0.1 * number(random);
  body.rates();
  double total = 0, scale = 0, power = 0;
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    total += body.V[a] * body.R.J[a];
    scale += body.V[a] * std::abs(body.R.J[a]);
    power += body.V[a] * body.R.J[a] * body.U.J[a];
  }
  EXPECT_LT(std::abs(total), 1e-12 * scale);
  EXPECT_LT(power, -0.01 * scale);
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    body.U.J[a] = 1 + 0.1 * cloud.X[a][0] - 0.2 * cloud.X[a][1];
  body.rates();
  for (const double rate : body.R.J)
    EXPECT_LT(std::abs(rate), 1e-11 * scale / cloud.domain_volume);
}
