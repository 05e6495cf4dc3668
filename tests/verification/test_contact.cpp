/// Bodies against rigid tools: what mechanics says of the momenta, and that nothing passes.
#include "solver/boundary/cavity.hpp"
#include "solver/boundary/polyline.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace tessera;
using namespace tessera::solver;

namespace {

using Rows = std::vector<std::vector<double>>;

Expression number(double value) {
  return Expression(std::to_string(value));
}

/// History rows of a run: time in column 0, balance error in 9, linear momentum in 10 to 12.
Rows history(const SceneSpec& scene, const ParticleCloud& cloud) {
  Rows rows;
  Outputs outputs;
  outputs.history_row = [&](const std::vector<double>& row) { rows.push_back(row); };
  run(scene, cloud, outputs, Progress::silent());
  return rows;
}

/// Smallest distance of any particle from any of the shapes over the frames of a run, m.
double least_distance(const SceneSpec& scene, const ParticleCloud& cloud,
                      const std::vector<std::shared_ptr<const RigidShape>>& shapes, double* balance_error) {
  double least = INFINITY;
  Outputs outputs;
  outputs.frame = [&](const Frame& frame) {
    for (std::size_t a = 0; a < cloud.X.size(); ++a) {
      const double* u = &frame.fields[0].values[3 * a];
      for (const auto& shape : shapes)
        least = std::min(least, shape->gap(cloud.X[a] + Vec3(u[0], u[1], u[2])).distance);
    }
  };
  *balance_error = run(scene, cloud, outputs, Progress::silent()).energy.balance_error;
  return least;
}

/// The inside of a sphere around the origin.
class Ball final : public RigidShape {
 public:
  explicit Ball(double radius) : radius_(radius) {}
  Gap gap(const Vec3& x) const override { return {x.norm() - radius_, x.stableNormalized()}; }
  bool two_sided() const override { return true; }

 private:
  double radius_;
};

} // namespace

class Impact : public ::testing::TestWithParam<ContactMethod> {};

INSTANTIATE_TEST_SUITE_P(Contact, Impact,
                         ::testing::Values(ContactMethod::reflection, ContactMethod::penalty),
                         [](const auto& method) {
                           return method.param == ContactMethod::reflection ? "Reflection" : "Penalty";
                         });

TEST_P(Impact, OfAnElasticBarIsTheWaveGoingUpAndDown) {
  // Without Poisson's ratio a plane bar is one of one dimension: for 2 L / c the tool presses on it with rho
  // c v, then it flies off as fast as it came. Seen from a tool that moves along it is the same.
  const double L = 1, density = 1000, young = 1e9, v = 0.1, c = 1000;
  const auto rebound = [&](int layers, double tool) {
    const double spacing = L / (layers - 1), width = 4 * spacing, mass = density * L * width;
    const auto cloud = test::box_lattice(5, layers, 1, Vec3(width, L, 0));
    SceneSpec scene;
    scene.scheme = "thesis";
    scene.material = {"linear_elastic", density, young, 0, std::nullopt};
    scene.end_time = 3 * L / c;
    scene.history_rows = 300;
    scene.initial.push_back({"all", Formulas{number(0), number(tool - v), number(0)}});
    scene.walls.push_back(
        {"ram", std::make_shared<Plane>(Vec3::Zero(), Vec3::UnitY()), 0, 0, GetParam(), 1, Vec3(0, tool, 0)});
    const Rows rows = history(scene, cloud);
    // Of the centre of mass, over the impact's.
    const auto velocity_at = [&](double time) {
      const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r[0] >= time; });
      return (row->at(11) / mass - tool) / v;
    };
    // The springs of the penalty, a depth of 2 v / c spacings, take their time to be pressed.
    const double late = GetParam() == ContactMethod::penalty ? 2 * spacing / c : 0;
    for (const double t : {0.5, 1.0, 1.5})
      EXPECT_NEAR(velocity_at(t * L / c), t - 1 - late * c / L, 0.02) << t << " " << tool;
    EXPECT_NEAR(velocity_at(2.9 * L / c), velocity_at(2.6 * L / c), 1e-3); // flies freely
    return velocity_at(2.9 * L / c);
  };
  const double coarse = 1 - rebound(41, 0), fine = 1 - rebound(81, 0);
  EXPECT_LT(coarse, 0.04);
  EXPECT_LT(fine, 0.7 * coarse);
  EXPECT_NEAR(rebound(41, 0.4), 1 - coarse, 1e-9);
}

TEST_P(Impact, FrictionTakesItsShareOfTheNormalImpulseWhereverTheBodySlides) {
  const double mu = 0.3;
  const auto cloud = test::box_lattice(9, 9, 1, Vec3(0.08, 0.08, 0));
  const std::vector<std::shared_ptr<const RigidShape>> floors = {
      std::make_shared<Plane>(Vec3::Zero(), Vec3::UnitY()),
      std::make_shared<Polyline>(std::vector<Vec<2>>{{0, 0}, {1, 0}, {1, -1}}, std::vector<double>{0.1})};
  for (const auto& floor : floors) {
    SceneSpec scene;
    scene.scheme = "thesis";
    scene.material = {"neo_hookean", 1000, 1e7, 0.3, std::nullopt};
    scene.end_time = 2e-3;
    scene.initial.push_back({"all", Formulas{number(10), number(-0.5), number(0)}});
    scene.walls.push_back({"floor", floor, mu, 0, GetParam()});
    const Rows rows = history(scene, cloud);
    const double along = rows.back()[10] - rows.front()[10], across = rows.back()[11] - rows.front()[11];
    EXPECT_GT(across, 0.5 * 1000 * 0.08 * 0.08);
    EXPECT_NEAR(along / across, -mu, 1e-11);
    EXPECT_LT(rows.back()[9], 1e-3);
  }
}

TEST(Contact, ABodyInTheCavityOfAToolStaysThere) {
  const auto ball = std::make_shared<Ball>(0.1);
  auto cloud = test::box_lattice(6, 6, 6, Vec3(0.1, 0.1, 0.1));
  for (Vec3& X : cloud.X)
    X -= Vec3::Constant(0.05); // corners at 0.0866
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"neo_hookean", 1000, 1e6, 0.3, std::nullopt};
  scene.end_time = 0.02;
  scene.frames = 50;
  scene.initial.push_back({"all", Formulas{number(3), number(2), number(-1)}});
  scene.walls.push_back({"ball", ball});
  double balance_error = 0;
  EXPECT_GT(least_distance(scene, cloud, {std::make_shared<Cavity>(ball)}, &balance_error), -1e-12);
  EXPECT_LT(balance_error, 0.01);
}

TEST(Contact, ARubberBilletGoesThroughTwoTurnsWithoutPassingTheDie) {
  const double mm = 1e-3;
  const auto [left, right] = channel(
      {{4 * mm, 56 * mm}, {4 * mm, -4 * mm}, {28 * mm, -4 * mm}, {28 * mm, -60 * mm}}, 8 * mm, 1.5 * mm, mm);
  const auto cloud = test::box_lattice(9, 25, 1, Vec3(8 * mm, 24 * mm, 0));
  SceneSpec scene;
  scene.scheme = "thesis";
  scene.material = {"neo_hookean", 1000, 1e6, 0.3, std::nullopt};
  scene.end_time = 6e-3;
  scene.frames = 60;
  scene.initial.push_back({"all", Formulas{number(0), number(-12), number(0)}});
  scene.walls = {{"left", left}, {"right", right}};
  double balance_error = 0;
  EXPECT_GT(least_distance(scene, cloud, {left, right}, &balance_error), -1e-12);
  EXPECT_LT(balance_error, 0.02);
}
