/// Where the equations of an elastic law are hyperbolic: all waves real in all directions, m.Q(N).m >= 0 for
/// all m and N (rank-one convexity, the condition of Legendre and Hadamard).
#pragma once

#include "solver/physics/materials/acoustic.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tessera::solver {

/// The smallest rho0 c^2 over all directions and polarisations, Pa: negative where hyperbolicity is lost.
/// For an F whose principal axes are those of the coordinates. What is less than 1e-10 of the stiffest entry
/// is lost in the differences that made it, and zero.
double slowest_wave(const Elasticity& elasticity);

/// A law with constants, reduced to its stress.
struct StudiedLaw {
  std::string label;                      ///< of curves and tables
  std::string law;                        ///< of the catalogue
  std::string constants;                  ///< for people
  double mu = 0;                          ///< shear modulus of small strains, Pa
  std::function<Mat3(const Mat3&)> piola; ///< P(F) with H and J those of F, Pa
};

/// Every law of the catalogue: the rubber of the thesis for Ogden's at Poisson's ratios 0.45 and 0.4995, the
/// others at E = 17 MPa and 0.3 and 0.45. Mooney and Rivlin's with c1 = c2 and with the area term alone,
/// Ogden's also with kappa/2 (J - 1)^2 in place of its own volumetric energy.
std::vector<StudiedLaw> laws_to_study();

/// Stretches from 1/range to range are looked at.
inline constexpr double stretch_range = 5;

struct StretchPoint {
  double stretch; ///< what the path goes by
  Vec3 stretches; ///< all three
  double slowest; ///< slowest_wave / mu
};

/// A way through the stretched states, followed from rest to both sides.
struct StretchPath {
  std::string name;                 ///< of stretch_paths
  std::vector<StretchPoint> points; ///< by increasing stretch; ends early where the equilibria from rest do
  std::optional<StretchPoint> lost_below, lost_above; ///< the first under and over 1 without hyperbolicity
};

/// uniaxial (s, l, l) and biaxial (s, s, l) with l such that its direction is free of stress; pure_shear
/// (s, 1/s, 1), which is also simple shear of s - 1/s; volumetric (s, s, s).
const std::vector<std::string>& stretch_paths();

/// A plane of stretches (s1, s2, .): where rays from rest in (ln s1, ln s2) first lose hyperbolicity, or
/// leave the range.
struct StretchRegion {
  std::string name;                        ///< plane_strain: s3 = 1; isochoric: s3 = 1 / (s1 s2)
  std::vector<std::array<double, 2>> edge; ///< (s1, s2), once around
  double lost_fraction;                    ///< of a grid even in (ln s1, ln s2)
};

struct Hyperbolicity {
  StudiedLaw subject;
  double lost_fraction; ///< of a grid of all three stretches even in their logarithms
  /// The smallest volume ratio from 1 on, and the largest under 1, at which a loss was seen on grid or paths.
  std::optional<double> lost_swollen, lost_compressed;
  std::vector<StretchPath> paths;
  std::vector<StretchRegion> regions;
};

Hyperbolicity study_hyperbolicity(const StudiedLaw& law);

} // namespace tessera::solver
