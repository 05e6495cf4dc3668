/// Patch tests of the scheme "consistent": a constant stress with its tractions, given as a case gives them,
/// leaves no force on any particle of any cloud, and a linear field has its slope.
#include "core/error.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "solver/operators/consistent.hpp"
#include "solver/scene/conditions.hpp"
#include "solver/scene/graph.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

using namespace tessera;
using namespace tessera::solver;
using preprocess::Arrangement;

namespace {

/// A cloud and the sets that make up its whole boundary.
struct Patch {
  const char* name;
  std::function<ParticleCloud()> cloud;
  std::vector<std::string> faces;

  friend void PrintTo(const Patch& patch, std::ostream* out) { *out << patch.name; }
};

ParticleCloud prepared(const preprocess::Domain& domain, Arrangement arrangement, int count,
                       int relax_seeds = 0) {
  preprocess::ParticleRequest request;
  request.arrangement = arrangement;
  request.count = count;
  request.relax_seeds = relax_seeds;
  return preprocess::prepare(domain, request, Progress::silent()).cloud;
}

Patch patch(const char* name, const preprocess::Domain& domain, Arrangement arrangement, int count,
            int relax_seeds = 0) {
  return {name, [=] { return prepared(domain, arrangement, count, relax_seeds); }, domain.surfaces};
}

const std::vector<std::string> box_faces = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
const std::vector<std::string> square_faces = {"x_min", "x_max", "y_min", "y_max"};

std::vector<Patch> patches(int dimension) {
  const auto two_pass = Arrangement::voronoi, poisson = Arrangement::poisson, lattice = Arrangement::lattice;
  if (dimension == 2)
    return {patch("Rectangle", test::square_slab(), two_pass, 300),
            patch("Angle", test::l_slab(), two_pass, 400),
            patch("AngleRelaxed", test::l_slab(), two_pass, 400, 10),
            patch("Holed", test::holed_slab(3), two_pass, 400),
            patch("HoledPoisson", test::holed_slab(3), poisson, 400),
            patch("HoledLattice", test::holed_slab(3), lattice, 400),
            {"Jittered",
             [] { return test::jittered(test::box_lattice(13, 17, 1, Vec3(1.2, 1.6, 0)), 0.3, 3); },
             square_faces}};
  return {patch("Box", test::box_domain(), two_pass, 500),
          patch("LPart", test::l_domain(), two_pass, 900),
          patch("LPartRelaxed", test::l_domain(), two_pass, 900, 10),
          patch("LPartPoisson", test::l_domain(), poisson, 900),
          patch("LPartLatticeBesideItsFaces", test::l_domain(), lattice, 900),
          patch("Bored", test::holed_domain(2), two_pass, 900),
          patch("BoredPoisson", test::holed_domain(2), poisson, 900),
          {"Jittered", [] { return test::jittered(test::box_lattice(8, 9, 7, Vec3(1.4, 1.6, 1.2)), 0.3, 3); },
           box_faces}};
}

SceneSpec elastic(const std::string& law = "linear_elastic") {
  SceneSpec scene;
  scene.scheme = "consistent";
  scene.material.law = law;
  scene.material.density = 1000;
  scene.material.young = 1e6;
  scene.material.poisson = 0.3;
  return scene;
}

template <int D>
struct Operators {
  ParticleCloud cloud;
  Neighbours graph;
  Gradient<D> gradient;

  explicit Operators(const Patch& patch)
      : cloud(patch.cloud()), graph(build_graph<D>(elastic(), cloud)),
        gradient(build_gradient<D>(cloud.X, cloud.V, graph)) {
    balance_constant_stress<D>(gradient, cloud.X, cloud.A, graph);
  }

  /// The largest force on a particle of a stress P and the scene's loads, over |P| and the largest area.
  double unbalanced(const Mat<D>& P, const SceneSpec& scene, const std::vector<Vec<D>>& besides = {}) const {
    const Conditions<D> conditions = make_conditions<D>(scene, cloud, 1, 1);
    std::vector<Vec<D>> force(cloud.X.size(), Vec<D>::Zero());
    const std::vector<Mat<D>> undeformed(cloud.X.size(), Mat<D>::Identity());
    for (const auto& load : conditions.loads)
      load->add({cloud.X, cloud.V, 1000, {undeformed, {}, {}}, 0}, force);
    double worst = 0, largest = 0;
    for (std::size_t a = 0; a < cloud.X.size(); ++a) {
      const auto i = static_cast<std::int64_t>(a);
      Vec<D> T = Vec<D>::Zero();
      for (std::int64_t e = graph.row[a]; e < graph.row[a + 1]; ++e)
        T += P * (gradient.w(i, e, graph.column[e]) + gradient.t(i, e, graph.column[e]));
      Vec<D> left = cloud.V[a] * (force[a] + T);
      if (!besides.empty())
        left += besides[a];
      worst = std::max(worst, left.norm());
      largest = std::max(largest, cloud.A[a].norm());
    }
    return worst / largest / P.norm();
  }
};

/// The direction of a set whose areas are parallel; zero of curved ones.
Vec3 normal_of(const ParticleSet& set) {
  Vec3 total = Vec3::Zero();
  double size = 0;
  for (const Vec3& A : set.area) {
    total += A;
    size += A.norm();
  }
  return total.norm() > (1 - 1e-12) * size ? total.normalized() : Vec3(Vec3::Zero());
}

BoundaryCondition traction(const std::string& on, const Vec3& t) {
  BoundaryCondition condition;
  condition.kind = BoundaryCondition::Kind::traction;
  condition.on = on;
  for (int c = 0; c < 3; ++c)
    condition.values.emplace_back(fmt::format("{:.17g}", t[c]));
  return condition;
}

BoundaryCondition pressure(const std::string& on, double p) {
  BoundaryCondition condition;
  condition.kind = BoundaryCondition::Kind::pressure;
  condition.on = on;
  condition.values.emplace_back(fmt::format("{:.17g}", p));
  return condition;
}

template <int D>
void balances_every_stress(const Patch& patch) {
  const Operators<D> body(patch);
  Mat<D> P; // unsymmetric
  for (int i = 0; i < D * D; ++i)
    P.data()[i] = 1e6 * (1.3 * i - 2.1 + 0.4 * i * i);

  // A traction is P N of a flat face; a curved one has what a traction would need the normal of every
  // particle's share for.
  SceneSpec scene = elastic();
  std::vector<Vec<D>> curved(body.cloud.X.size(), Vec<D>::Zero());
  for (const std::string& face : patch.faces) {
    const ParticleSet& set = body.cloud.set(face);
    const Vec3 N = normal_of(set);
    Vec3 t = Vec3::Zero();
    t.head<D>() = P * N.template head<D>();
    if (N.squaredNorm() > 0)
      scene.boundary.push_back(traction(face, t));
    else
      for (std::size_t k = 0; k < set.particles.size(); ++k)
        curved[set.particles[k]] += P * set.area[k].template head<D>();
  }
  EXPECT_LT(body.unbalanced(P, scene, curved), 1e-10) << patch.name;

  SceneSpec pressed = elastic();
  for (const std::string& face : patch.faces)
    pressed.boundary.push_back(pressure(face, 3e5));
  EXPECT_LT(body.unbalanced(-3e5 * Mat<D>::Identity(), pressed), 1e-10) << patch.name;
}

template <int D>
void has_exact_slopes(const Patch& patch) {
  const Operators<D> body(patch);
  Mat<D> slope;
  for (int i = 0; i < D * D; ++i)
    slope.data()[i] = 0.3 * i - 0.8;
  const Vec3 middle = body.cloud.X[body.cloud.X.size() / 2];
  const auto f = [&](std::int64_t a) -> Vec<D> {
    return slope * (body.cloud.X[a] - middle).template head<D>();
  };
  for (std::int64_t a = 0; a < body.graph.size(); ++a) {
    Mat<D> G = Mat<D>::Zero();
    for (std::int64_t e = body.graph.row[a]; e < body.graph.row[a + 1]; ++e)
      G += (f(body.graph.column[e]) - f(a)) * body.gradient.w(a, e, body.graph.column[e]).transpose();
    ASSERT_LT((G - slope).norm() / slope.norm(), 1e-12) << patch.name << ", particle " << a;
  }
}

/// Largest speed (m/s) of a body that begins evenly deformed, x = stretch X in all directions, under the
/// following pressure that holds it there.
double speed_at_rest(const Patch& patch, double stretch) {
  const ParticleCloud cloud = patch.cloud();
  SceneSpec scene = elastic("neo_hookean");
  scene.initial.push_back({"all", std::nullopt,
                           Formulas{Expression(fmt::format("{:.17g}*X", stretch - 1)),
                                    Expression(fmt::format("{:.17g}*Y", stretch - 1)),
                                    Expression(fmt::format("{:.17g}*Z", stretch - 1))}});
  // Neo-Hookean P of F = diag(s, s, s) or, in the plane, diag(s, s, 1), over H = J / s.
  const double mu = 1e6 / 2.6, kappa = 1e6 / 1.2, s = stretch;
  const double thickness = cloud.dimension == 3 ? s : 1, J = s * s * thickness;
  const double squares = 2 * s * s + thickness * thickness;
  const double sigma = mu * std::pow(J, -5.0 / 3) * (s * s - squares / 3) + kappa * (J - 1);
  for (const std::string& face : patch.faces)
    scene.boundary.push_back(pressure(face, -sigma));
  scene.end_time = 0.02;
  double speed = 0;
  Outputs outputs;
  outputs.frame = [&](const Frame& frame) {
    for (const Field& field : frame.fields)
      if (field.name == "Velocity")
        for (const double v : field.values)
          speed = std::max(speed, std::abs(v));
  };
  EXPECT_GT(run(scene, cloud, outputs, Progress::silent()).steps, 5) << patch.name;
  return speed;
}

class PlanePatch : public testing::TestWithParam<Patch> {};
class SpacePatch : public testing::TestWithParam<Patch> {};
const auto name_of = [](const auto& param) { return std::string(param.param.name); };
INSTANTIATE_TEST_SUITE_P(Clouds, PlanePatch, testing::ValuesIn(patches(2)), name_of);
INSTANTIATE_TEST_SUITE_P(Clouds, SpacePatch, testing::ValuesIn(patches(3)), name_of);

} // namespace

TEST_P(PlanePatch, ConstantStressAndItsTractionsLeaveNoForce) {
  balances_every_stress<2>(GetParam());
}

TEST_P(SpacePatch, ConstantStressAndItsTractionsLeaveNoForce) {
  balances_every_stress<3>(GetParam());
}

TEST_P(PlanePatch, LinearFieldsHaveTheirSlope) {
  has_exact_slopes<2>(GetParam());
}

TEST_P(SpacePatch, LinearFieldsHaveTheirSlope) {
  has_exact_slopes<3>(GetParam());
}

TEST_P(PlanePatch, EvenlySqueezedBodiesStayAtRest) {
  EXPECT_LT(speed_at_rest(GetParam(), 0.9), 1e-9); // pressure waves: 37 m/s
}

TEST_P(SpacePatch, EvenlySqueezedBodiesStayAtRest) {
  EXPECT_LT(speed_at_rest(GetParam(), 0.9), 1e-9);
}
