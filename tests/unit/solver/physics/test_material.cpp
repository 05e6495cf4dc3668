#include "solver/physics/material.hpp"

#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/materials/ogden.hpp"
#include "solver/physics/plasticity/hardening.hpp"
#include "solver/physics/plasticity/von_mises.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace tessera;
using namespace tessera::solver;

namespace {

using Copper = VonMises<LinearHardening>;
const Copper copper{{ElasticConstants::from(117e9, 0.35)}, {0.4e9, 0.1e9}};

std::vector<Mat3> pulled(double stretch) {
  const double across = 1 / std::sqrt(stretch);
  return {Mat3::Identity(), Vec3(stretch, across, across).asDiagonal()};
}

} // namespace

TEST(Material, StressesWithinAStepLeaveTheHistoriesAsTheyAre) {
  MaterialOf<3, Copper> material(copper, 2);
  const auto F = pulled(1.3);
  std::vector<Mat3> first(2), second(2), committed(2);
  material.stresses({F, {}, {}}, 0, first);
  EXPECT_EQ(material.equivalent_plastic_strain(1), 0);
  material.stresses({F, {}, {}}, 0, second);
  EXPECT_EQ(first[1], second[1]);
  std::vector<double> moduli(2);
  material.commit({F, {}, {}}, 0, committed, moduli);
  EXPECT_EQ(committed[1], first[1]);
  EXPECT_EQ(material.equivalent_plastic_strain(0), 0);
  // ln 1.3 less the elastic part, stress / (3 mu).
  EXPECT_NEAR(material.equivalent_plastic_strain(1), std::log(1.3), 4e-3);
  EXPECT_LT(material.equivalent_plastic_strain(1), std::log(1.3));
}

TEST(Material, ACommitIsMadeOnceAStep) {
  // The state a commit leaves is on the yield surface: the same strains again change nothing more.
  MaterialOf<3, Copper> material(copper, 2);
  const auto F = pulled(1.3);
  std::vector<Mat3> P(2);
  std::vector<double> moduli(2);
  material.commit({F, {}, {}}, 0, P, moduli);
  const double strain = material.equivalent_plastic_strain(1);
  material.commit({F, {}, {}}, 0, P, moduli);
  EXPECT_NEAR(material.equivalent_plastic_strain(1) / strain, 1, 1e-12);
}

TEST(Material, KnowsTheFastestWaveOfTheStrainedBody) {
  MaterialOf<3, Hencky> material(Hencky{ElasticConstants::from(117e9, 0.35)}, 2);
  std::vector<Mat3> P(2);
  std::vector<double> moduli(2);
  material.commit({pulled(1.5), {}, {}}, 0, P, moduli);
  const double at_rest = material.linearised().pressure_wave_modulus();
  EXPECT_NEAR(moduli[0] / at_rest, 1, 1e-12);
  EXPECT_GE(moduli[1] / at_rest, 1.5 * (1 - 1e-12)); // over the smallest stretch squared, 1 / 1.5
}

TEST(Material, TheStepKeepsToTheRuleUntilALawOutrunsIt) {
  // (3.93): the wave at rest over the smallest stretch. Rubber in moderate strain goes by it to the bit;
  // Ogden's law in compression has waves more than twice as fast.
  const Strain twisted = Strain::of(Vec3(1.3, 0.8, 1 / (1.3 * 0.8)).asDiagonal());
  const NeoHookean rubber{ElasticConstants::from(17e6, 0.45)};
  EXPECT_EQ(step_wave_modulus(rubber, twisted),
            rubber.elastic.pressure_wave_modulus() / squared_stretches(twisted.F)[0]);
  const Ogden ogden{{{0.63e6, 1.3}, {0.0012e6, 5}, {-0.01e6, -2}}, 4e6};
  const Strain pressed = Strain::of(0.9 * Mat3::Identity());
  EXPECT_EQ(step_wave_modulus(ogden, pressed),
            ogden.stiffened_modulus(pressed, squared_stretches(pressed.F)));
  EXPECT_GT(step_wave_modulus(ogden, pressed), 2 * ogden.linearised().pressure_wave_modulus() / 0.81);
}

TEST(Material, ElasticOnesRememberNothing) {
  EXPECT_EQ((MaterialOf<2, Hencky>(Hencky{ElasticConstants::from(1e9, 0.3)}, 5).history_bytes()), 0U);
  EXPECT_EQ((MaterialOf<2, Copper>(copper, 5).history_bytes()), sizeof(Copper::History));
}
