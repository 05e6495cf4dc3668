#include "solver/physics/materials/hyperbolicity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace tessera;
using namespace tessera::solver;

namespace {

const StudiedLaw& named(const std::string& label) {
  static const std::vector<StudiedLaw> laws = laws_to_study();
  const auto found =
      std::find_if(laws.begin(), laws.end(), [&](const auto& law) { return law.label == label; });
  if (found == laws.end())
    throw std::runtime_error("no law is labelled " + label);
  return *found;
}

const StretchPath& path(const Hyperbolicity& study, const std::string& name) {
  const auto& names = stretch_paths();
  return study.paths[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
}

} // namespace

TEST(Hyperbolicity, TheSlowestWaveIsFoundWhereverItRuns) {
  // Against all directions of a fine net over the sphere, itself within a part in a thousand of the minimum.
  constexpr int net = 60;
  for (const char* label :
       {"Hencky 0.3", "Saint Venant 0.3", "Area term 0.3", "Mooney-Rivlin 0.45", "Ogden 0.45"})
    for (const Vec3& stretches :
         {Vec3(2.2, 1.1, 0.6), Vec3(0.4, 0.5, 1.9), Vec3(3, 3, 0.3), Vec3(1.2, 1.2, 1.2)}) {
      const Elasticity at = elasticity_of(named(label).piola, Mat3(stretches.asDiagonal()));
      double least = std::numeric_limits<double>::infinity();
      double scale = 0;
      for (int i = -net; i <= net; ++i)
        for (int j = 0; j < 2 * net; ++j) {
          const double z = i / double(net), angle = std::numbers::pi * j / net, ring = std::sqrt(1 - z * z);
          const Vec3 moduli =
              wave_moduli(at.acoustic(Vec3(ring * std::cos(angle), ring * std::sin(angle), z)));
          least = std::min(least, moduli[0]);
          scale = std::max(scale, moduli[2]);
        }
      const double found = slowest_wave(at);
      EXPECT_LE(found, least + 1e-9 * scale) << label << " " << stretches.transpose();
      EXPECT_GE(found, least - 2e-3 * scale) << label << " " << stretches.transpose();
    }
}

TEST(Hyperbolicity, SaintVenantKirchhoffLosesItWhereItsFormulasSay) {
  // Compressed evenly, S = (3 lambda + 2 mu) E I with s^2 = 1 + 2 E: shear waves S + mu s^2 go first.
  const Hyperbolicity study = study_hyperbolicity(named("Saint Venant 0.3"));
  const ElasticConstants e = ElasticConstants::from(17e6, 0.3);
  EXPECT_NEAR(path(study, "volumetric").lost_below->stretch,
              std::sqrt(1 - 2 * e.mu / (3 * e.lambda + 4 * e.mu)), 1e-8);
  EXPECT_FALSE(path(study, "volumetric").lost_above);
  // Pulled, the sides of a bar with nu = 0.3 are gone where s^2 = 1 + 1 / nu.
  EXPECT_LT(path(study, "uniaxial").points.back().stretch, std::sqrt(1 + 1 / 0.3));
  EXPECT_GT(path(study, "uniaxial").points.back().stretch, 0.95 * std::sqrt(1 + 1 / 0.3));
  EXPECT_FALSE(path(study, "uniaxial").lost_above);
}

TEST(Hyperbolicity, HenckyLosesItInPureShearAndSwelling) {
  const Hyperbolicity study = study_hyperbolicity(named("Hencky 0.45"));
  // s and 1/s are the same state of shear.
  const StretchPath& shear = path(study, "pure_shear");
  EXPECT_NEAR(shear.lost_below->stretch * shear.lost_above->stretch, 1, 1e-6);
  // Swelling: the pressure wave, kappa (1 - ln J) + 4 mu/3.
  const ElasticConstants e = ElasticConstants::from(17e6, 0.45);
  EXPECT_NEAR(3 * std::log(path(study, "volumetric").lost_above->stretch), 1 + 4 * e.mu / (3 * e.kappa),
              1e-8);
  EXPECT_FALSE(path(study, "volumetric").lost_below);
}

TEST(Hyperbolicity, OfOgdensRubberEndsWhereItsVolumetricEnergyIsConcave) {
  const Hyperbolicity rubber = study_hyperbolicity(named("Ogden 0.4995"));
  // beta = 9: U'' < 0 beyond J = 10^(1/9); shear puts it off a little.
  const double swollen = path(rubber, "volumetric").lost_above->stretches.prod();
  EXPECT_GT(swollen, std::pow(10, 1.0 / 9));
  EXPECT_LT(swollen, 1.01 * std::pow(10, 1.0 / 9));
  EXPECT_GT(*rubber.lost_swollen, std::pow(10, 1.0 / 9));
  EXPECT_FALSE(rubber.lost_compressed);
  EXPECT_EQ(rubber.regions[1].lost_fraction, 0); // none at J = 1
  // The isochoric part alone never does.
  EXPECT_EQ(study_hyperbolicity(named("Ogden, convex U 0.4995")).lost_fraction, 0);
}

TEST(Hyperbolicity, OfNeoHookeanBodiesIsNeverLost) {
  // Polyconvex, hence rank-one convex.
  const Hyperbolicity study = study_hyperbolicity(named("Neo-Hookean 0.3"));
  EXPECT_EQ(study.lost_fraction, 0);
  for (const StretchPath& along : study.paths)
    for (const StretchPoint& point : along.points)
      EXPECT_GT(point.slowest, 0) << along.name << " " << point.stretch;
}
