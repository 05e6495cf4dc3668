/// The step that the spectrum of a body's operators allows, against real runs in steps a little shorter and a
/// little longer: fields that stay, and fields that grow.
#include "preprocess/cloud/prepare.hpp"
#include "solver/scene/assemble.hpp"
#include "solver/scene/stability.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <string>

using namespace tessera;
using namespace tessera::solver;

namespace {

struct CloudKind {
  const char* name;
  preprocess::ParticleRequest request;
};

void PrintTo(const CloudKind& kind, std::ostream* out) {
  *out << kind.name;
}

CloudKind lattice(const char* name, double jitter) {
  preprocess::ParticleRequest request;
  request.spacing = 0.25;
  request.jitter = jitter;
  return {name, request};
}
CloudKind two_pass(const char* name, int sweeps) {
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = 100;
  request.relax_seeds = request.relax = sweeps;
  return {name, request};
}

ParticleCloud cloud_of(const CloudKind& kind) {
  return preprocess::prepare(test::box_domain(), kind.request, Progress::silent()).cloud;
}

SceneSpec scene_with(const std::string& scheme) {
  SceneSpec scene;
  scene.scheme = scheme;
  scene.formulation = "pF";
  scene.material = {"neo_hookean", 1100, 17e6, 0.3, std::nullopt};
  return scene;
}

/// By how much of itself a small random disturbance, without rigid motion, grows in a step of a long run:
/// over its second half, when the field that grows most, or fades least, has outlived the others.
template <class Dissipation, class Formulation = PF<3>>
double growth_in_run(const SceneSpec& scene, const ParticleCloud& cloud, double dt, int steps) {
  return assemble<Formulation, Dissipation>(scene, cloud, [&](auto& assembly) {
    auto& body = assembly.body;
    constexpr double begun = 1e-7, faded = 1e-5 * begun; // what then grows is round-off
    std::mt19937_64 random(3);
    for (Vec3& p : body.U.p)
      for (double& component : p)
        component =
            begun * body.density * body.wave_speed * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
    project_momentum<3>(body.U.p, body.U.x, body.V);
    assembly.step->start(body, dt);
    const int window = steps / 20; // longer than any field swings
    double middle = 0, late = 0;
    for (int i = 0; i < steps; ++i) {
      try {
        (*assembly.step)(body, i * dt, dt);
      } catch (const Breakdown&) {
        return std::numeric_limits<double>::infinity();
      }
      double size = 0;
      for (const Vec3& p : body.U.p)
        size = std::max(size, p.norm() / (body.density * body.wave_speed));
      if (!(size < 1e-3)) // not small any more
        return std::numeric_limits<double>::infinity();
      if (i >= steps / 2 && i < steps / 2 + window)
        middle = std::max(middle, size);
      if (i >= steps - window)
        late = std::max(late, size);
    }
    return late < faded ? -1 : std::log(late / middle) / (steps / 2 - window);
  });
}

/// In steps 5 % shorter and longer than the spectrum allows: beyond what the operators feed by themselves.
template <class Dissipation>
void expect_limit(const SceneSpec& scene, const ParticleCloud& cloud, int steps) {
  const StabilityFindings findings = stability(scene, cloud, Vec3::Ones());
  ASSERT_TRUE(findings.spectrum && findings.spectrum->largest_step);
  EXPECT_FALSE(findings.spectrum->grows);
  const double largest = *findings.spectrum->largest_step;
  EXPECT_LE(growth_in_run<Dissipation>(scene, cloud, 0.95 * largest, steps), tolerated_growth);
  EXPECT_GT(growth_in_run<Dissipation>(scene, cloud, 1.05 * largest, steps), tolerated_growth);
}

class StableStep : public ::testing::TestWithParam<CloudKind> {};
const auto kinds = ::testing::Values(lattice("Lattice", 0), lattice("Jittered", 0.2), two_pass("TwoPass", 0),
                                     two_pass("Relaxed", 10));
const auto name_of = [](const auto& info) { return std::string(info.param.name); };

} // namespace

TEST_P(StableStep, OfTheConsistentSchemeIsWhereRunsBeginToGrow) {
  const SceneSpec scene = scene_with("consistent");
  const ParticleCloud cloud = cloud_of(GetParam());
  expect_limit<ResidualDissipation<3>>(scene, cloud, 2000);
  // Power iteration finds the same.
  const StabilityFindings findings = stability(scene, cloud, Vec3::Ones());
  EXPECT_NEAR(findings.step.critical / *findings.spectrum->largest_step, 1, 0.02);
}

TEST_P(StableStep, OfTheThesisSchemeIsWhereRunsBeginToGrow) {
  // Heun's method lets waves grow that JST hardly takes: slowly, on raw clouds.
  CloudKind kind = GetParam();
  if (kind.request.arrangement == preprocess::Arrangement::lattice && kind.request.jitter == 0)
    kind.request.subvolumes = preprocess::Subvolumes::uniform; // as the thesis has them; see below
  const bool irregular = kind.request.arrangement == preprocess::Arrangement::voronoi;
  expect_limit<Jst<3>>(scene_with("thesis"), cloud_of(kind), irregular ? 40000 : 6000);
}

INSTANTIATE_TEST_SUITE_P(Clouds, StableStep, kinds, name_of);

TEST(GrowthOfOperators, FieldsThatJstFeedsGrowAtTheRateOfTheirEigenvalue) {
  // With the exact subvolumes of a small free lattice, half cells on its faces, one field grows at any step.
  const SceneSpec scene = scene_with("thesis");
  const ParticleCloud cloud = cloud_of(lattice("Lattice", 0));
  const StabilityFindings findings = stability(scene, cloud, Vec3::Ones());
  ASSERT_TRUE(findings.spectrum && findings.spectrum->grows);
  double fastest = 0;
  for (const Complex& lambda : findings.spectrum->eigenvalues)
    fastest = std::max(fastest, 0.5 * std::log1p(heun_growth(lambda * findings.dt)));
  EXPECT_GT(fastest, 1e-3);
  EXPECT_NEAR(growth_in_run<Jst<3>>(scene, cloud, findings.dt, 4000) / fastest, 1, 0.02);
  // Neither symmetric JST nor held faces let any.
  SceneSpec symmetric = scene, held = scene;
  symmetric.dissipation = "jst_symmetric";
  held.boundary.push_back({BoundaryCondition::Kind::fixed, "zmin"});
  for (const SceneSpec& other : {symmetric, held})
    EXPECT_FALSE(stability(other, cloud, Vec3::Ones()).spectrum->grows);
}

TEST(StepMatrix, VolumeMapAndJstBearWhatTheStepsOwnMatrixSays) {
  // Not symmetric, and J of its own: by the eigenvalues of the whole step.
  SceneSpec scene = scene_with("consistent");
  scene.formulation = "pFJ";
  preprocess::ParticleRequest request;
  request.spacing = 0.5;
  const ParticleCloud cloud = cloud_of({"Few", request});
  for (const char* dissipation : {"linear_residual", "jst"}) {
    scene.dissipation = dissipation;
    const StabilityFindings findings = stability(scene, cloud, Vec3::Ones());
    ASSERT_TRUE(findings.spectrum && findings.spectrum->largest_step);
    EXPECT_EQ(findings.spectrum->eigenvalues.size(), 7U * 27);
    const double largest = *findings.spectrum->largest_step;
    const auto growth = [&](double dt) {
      return dissipation == std::string("jst")
                 ? growth_in_run<Jst<3, true>, PFJ<3>>(scene, cloud, dt, 4000)
                 : growth_in_run<ResidualDissipation<3, true>, PFJ<3>>(scene, cloud, dt, 4000);
    };
    EXPECT_LE(growth(0.95 * largest), tolerated_growth) << dissipation;
    EXPECT_GT(growth(1.05 * largest), tolerated_growth) << dissipation;
  }
}
