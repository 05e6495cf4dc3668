/// Symmetric JST and the residual dissipation take energy whatever the cloud, the velocities and the
/// strengths of the particles: their forms are negative semidefinite, by all eigenvalues of small clouds.
#include "preprocess/cloud/prepare.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/operators/support.hpp"
#include "solver/physics/body.hpp"
#include "solver/physics/jst.hpp"
#include "solver/physics/jst_symmetric.hpp"
#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/residual_dissipation.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

template <int D>
std::vector<std::pair<std::string, ParticleCloud>> clouds() {
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = 150;
  const ParticleCloud two_pass =
      preprocess::prepare(D == 3 ? test::box_domain() : test::square_slab(), request, Progress::silent())
          .cloud;
  const ParticleCloud lattice =
      D == 3 ? test::box_lattice(5, 6, 5, Vec3(0.8, 1, 0.8)) : test::box_lattice(12, 11, 1, Vec3(1.1, 1, 0));
  return {{"lattice", lattice}, {"jittered", test::jittered(lattice, 0.3, 7)}, {"two-pass", two_pass}};
}

/// A body at rest in the scheme "consistent" where its areas allow.
template <int D, class Dissipation>
Body<PF<D>, Dissipation> body_of(const ParticleCloud& cloud, bool consistent) {
  Neighbours graph = adaptive_support<D>(cloud.X, cloud.V, D == 3 ? 30 : 14, cloud.hidden);
  std::vector<Vec<D>> X;
  for (const Vec3& x : cloud.X)
    X.push_back(x.head<D>());
  Dissipation dissipation{};
  if constexpr (requires { dissipation.weigh(cloud.X, cloud.V, graph); }) {
    dissipation.weigh(cloud.X, cloud.V, graph);
  } else if constexpr (requires { dissipation.weigh(cloud.V); }) {
    dissipation.weigh(cloud.V);
  } else {
    dissipation.laplacian = build_laplacian<D>(cloud.X, cloud.V, graph);
    dissipation.delta = cloud.spacing;
  }
  Gradient<D> gradient = build_gradient<D>(cloud.X, cloud.V, graph);
  if (consistent)
    balance_constant_stress<D>(gradient, cloud.X, cloud.A, graph);
  const NeoHookean law{ElasticConstants::from(17e6, 0.45)};
  return Body<PF<D>, Dissipation>({std::move(X), 1100,
                                   std::make_unique<MaterialOf<D, NeoHookean>>(law, cloud.size()),
                                   std::move(graph), std::move(gradient), std::move(dissipation)});
}

double number(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

/// Waves of speeds that differ by up to a hundred from particle to particle.
template <class Body>
void vary_strengths(Body& body) {
  std::mt19937_64 random(11);
  for (double& c : body.wave)
    c *= std::pow(10.0, number(random));
  body.dissipation.advance(body);
}

struct Spectrum {
  double smallest, largest; ///< eigenvalues of the symmetric part, 1/s
  double skew;              ///< largest entry of the rest over the largest of all
  double asymmetry_of_sums; ///< largest |sum_a V_a D_a| of the columns over the largest entry
};

/// Of p -> D with the scalar product sum V p . q; each component sees itself alone.
template <class Body>
Spectrum spectrum(Body& body) {
  const auto n = static_cast<Eigen::Index>(body.size());
  Eigen::MatrixXd form(n, n), columns(n, n);
  for (Eigen::Index b = 0; b < n; ++b) {
    for (auto& p : body.U.p)
      p.setZero();
    body.U.p[b][0] = 1;
    body.rates(); // at rest: no stress
    for (Eigen::Index a = 0; a < n; ++a) {
      columns(a, b) = body.V[a] * body.R.p[a][0];
      form(a, b) = std::sqrt(body.V[a] / body.V[b]) * body.R.p[a][0];
    }
  }
  const Eigen::MatrixXd symmetric = 0.5 * (form + form.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric, Eigen::EigenvaluesOnly);
  return {eigen.eigenvalues()[0], eigen.eigenvalues()[n - 1],
          (form - symmetric).cwiseAbs().maxCoeff() / form.cwiseAbs().maxCoeff(),
          columns.colwise().sum().cwiseAbs().maxCoeff() / columns.cwiseAbs().maxCoeff()};
}

template <class Body>
void takes_energy_of_random_velocities(Body& body) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    for (auto& p : body.U.p)
      for (double& component : p)
        component = 1000 * number(random);
    body.rates();
    double power = 0, scale = 0;
    for (std::int64_t a = 0; a < body.size(); ++a) {
      power += body.V[a] * body.U.p[a].dot(body.R.p[a]);
      scale += body.V[a] * body.U.p[a].norm() * body.R.p[a].norm();
    }
    EXPECT_LT(power, -0.1 * scale); // random velocities are rough ones
  }
}

template <int D, class Dissipation>
void only_takes_energy() {
  for (const auto& [name, cloud] : clouds<D>())
    for (const bool vary : {false, true}) {
      SCOPED_TRACE(testing::Message() << D << "-D, " << name << (vary ? ", strengths vary" : ""));
      auto body = body_of<D, Dissipation>(cloud, name != "jittered");
      if (vary)
        vary_strengths(body);
      takes_energy_of_random_velocities(body);
      const Spectrum of = spectrum(body);
      EXPECT_LT(of.smallest, -body.wave_speed); // more than one a metre: it acts
      EXPECT_LE(of.largest, -1e-13 * of.smallest);
      EXPECT_LT(of.skew, 1e-13);
      EXPECT_LT(of.asymmetry_of_sums, 1e-12);
    }
}

} // namespace

TEST(EnergyDecay, OfSymmetricJst) {
  only_takes_energy<2, JstSymmetric<2>>();
  only_takes_energy<3, JstSymmetric<3>>();
}

TEST(EnergyDecay, OfTheResidualDissipation) {
  only_takes_energy<2, ResidualDissipation<2>>();
  only_takes_energy<3, ResidualDissipation<3>>();
}

TEST(EnergyDecay, IsNotWhatTheThesisJstDoes) {
  for (const auto& [name, cloud] : clouds<3>()) {
    auto body = body_of<3, Jst<3>>(cloud, false);
    const Spectrum of = spectrum(body);
    EXPECT_GT(of.largest, -0.01 * of.smallest) << name;
  }
}
