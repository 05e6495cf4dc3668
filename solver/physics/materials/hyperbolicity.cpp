#include "solver/physics/materials/hyperbolicity.hpp"

#include "solver/physics/materials/hencky.hpp"
#include "solver/physics/materials/linear_elastic.hpp"
#include "solver/physics/materials/mooney_rivlin.hpp"
#include "solver/physics/materials/neo_hookean.hpp"
#include "solver/physics/materials/ogden.hpp"
#include "solver/physics/materials/saint_venant_kirchhoff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tessera::solver {
namespace {

const double log_range = std::log(stretch_range);

/// Directions of one octant: the others are its mirror images where the principal axes are the coordinates'.
const std::vector<Vec3>& octant() {
  static const std::vector<Vec3> directions = [] {
    constexpr int parts = 6;
    std::vector<Vec3> all;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j)
        all.push_back(Vec3(i, j, parts - i - j).normalized());
    return all;
  }();
  return directions;
}

double slowest_at(const StudiedLaw& law, const Vec3& stretches) {
  return slowest_wave(elasticity_of(law.piola, Mat3(stretches.asDiagonal())));
}

/// Stretches of a path at its parameter; the free ones by Newton's method from a guess, which follows. None
/// where there is no equilibrium near the guess.
std::optional<Vec3> on_path(const StudiedLaw& law, const std::string& path, double s, double& guess) {
  if (path == "pure_shear")
    return Vec3(s, 1 / s, 1);
  if (path == "volumetric")
    return Vec3(s, s, s);
  const auto at = [&](double lateral) {
    return path == "uniaxial" ? Vec3(s, lateral, lateral) : Vec3(s, s, lateral);
  };
  const auto stress = [&](double lateral) { return law.piola(at(lateral).asDiagonal())(2, 2); };
  double lateral = guess;
  for (int i = 0; i < 40; ++i) {
    const double h = 1e-5 * lateral;
    const double step = -stress(lateral) * 2 * h / (stress(lateral + h) - stress(lateral - h));
    if (!(std::abs(step) < 0.2 * lateral)) // the branch has turned back or ended
      return std::nullopt;
    lateral += step;
    if (std::abs(step) < 1e-13 * lateral) {
      guess = lateral;
      return at(lateral);
    }
  }
  return std::nullopt;
}

/// The t in (held, lost] where hyperbolicity ends.
template <class Lost>
double first_loss(const Lost& lost_at, double held, double lost, double tolerance) {
  while (std::abs(lost - held) > tolerance) {
    const double middle = 0.5 * (held + lost);
    (lost_at(middle) ? lost : held) = middle;
  }
  return lost;
}

StretchPath follow(const StudiedLaw& law, const std::string& name) {
  constexpr int steps = 80;
  StretchPath path{name, {}, {}, {}};
  const auto point_at = [&](double t, double& lateral) -> std::optional<StretchPoint> {
    const auto stretches = on_path(law, name, std::exp(t), lateral);
    if (!stretches)
      return std::nullopt;
    return StretchPoint{std::exp(t), *stretches, slowest_at(law, *stretches) / law.mu};
  };
  for (const double sign : {-1.0, 1.0}) {
    double lateral = 1;
    std::optional<StretchPoint>& loss = sign < 0 ? path.lost_below : path.lost_above;
    for (int i = sign < 0 ? 0 : 1; i <= steps; ++i) {
      const double t = sign * log_range * i / steps, lateral_before = lateral;
      const auto point = point_at(t, lateral);
      if (!point)
        break;
      path.points.push_back(*point);
      if (point->slowest >= 0 || loss)
        continue;
      loss = point;
      const auto lost_at = [&](double at) {
        double near = lateral_before;
        const auto there = point_at(at, near);
        if (there && there->slowest < 0)
          loss = there;
        return !there || there->slowest < 0;
      };
      first_loss(lost_at, t - sign * log_range / steps, t, 1e-9);
    }
    if (sign < 0)
      std::reverse(path.points.begin(), path.points.end());
  }
  return path;
}

StretchRegion trace(const StudiedLaw& law, const std::string& name) {
  const auto stretches = [&](double t1, double t2) -> Vec3 {
    return Vec3(t1, t2, name == "isochoric" ? -t1 - t2 : 0).array().exp();
  };
  const auto within = [&](double t1, double t2) {
    return std::max({std::abs(t1), std::abs(t2), name == "isochoric" ? std::abs(t1 + t2) : 0}) <=
           log_range * (1 + 1e-12);
  };
  StretchRegion region{name, {}, 0};
  // Half of the rays; s1 and s2 change places in the other half.
  constexpr int rays = 90;
  std::vector<std::array<double, 2>> half;
  for (int ray = 0; ray <= rays; ++ray) {
    const double angle = std::numbers::pi * (0.25 + ray / static_cast<double>(rays));
    const double c = std::cos(angle), s = std::sin(angle);
    const double reach =
        log_range / std::max({std::abs(c), std::abs(s), name == "isochoric" ? std::abs(c + s) : 0});
    const auto lost_at = [&](double t) { return slowest_at(law, stretches(t * c, t * s)) < 0; };
    constexpr int steps = 32;
    double edge = reach;
    for (int i = 1; i <= steps; ++i)
      if (lost_at(reach * i / steps)) {
        edge = first_loss(lost_at, reach * (i - 1) / steps, reach * i / steps, 1e-5);
        break;
      }
    half.push_back({std::exp(edge * c), std::exp(edge * s)});
  }
  region.edge = half;
  for (auto point = half.rbegin() + 1; point != half.rend(); ++point)
    region.edge.push_back({(*point)[1], (*point)[0]});

  constexpr int grid = 40;
  int lost = 0, all = 0;
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= i; ++j) {
      const double t1 = log_range * (2.0 * i / grid - 1), t2 = log_range * (2.0 * j / grid - 1);
      if (!within(t1, t2))
        continue;
      const int weight = i == j ? 1 : 2;
      all += weight;
      if (slowest_at(law, stretches(t1, t2)) < 0)
        lost += weight;
    }
  region.lost_fraction = static_cast<double>(lost) / all;
  return region;
}

/// P(F) of an elastic law.
template <class L>
std::function<Mat3(const Mat3&)> stress_of(const L& law) {
  return [law](const Mat3& F) {
    typename L::History none;
    return law.piola(Strain::of(F), none);
  };
}

} // namespace

double slowest_wave(const Elasticity& elasticity) {
  const double stiffest = elasticity.matrix().cwiseAbs().maxCoeff();
  double slowest = std::numeric_limits<double>::infinity();
  Vec3 best;
  const auto improves = [&](const Vec3& N) {
    const double value = wave_moduli(elasticity.acoustic(N))[0];
    if (!(value < slowest - 1e-12 * stiffest)) // no wandering about where all directions are alike
      return false;
    slowest = value;
    best = N;
    return true;
  };
  for (const Vec3& N : octant())
    improves(N);
  // From the best on over the sphere, by steps to four sides that halve where none is better. Turns of m and
  // N, each the best for the other, would creep where the bulk modulus is large.
  for (double step = 0.1; step > 1e-5; step *= 0.5)
    for (bool moved = true; moved;) {
      moved = false;
      const Vec3 N = best, side = N.unitOrthogonal(), other = N.cross(side);
      for (const Vec3& way : {side, other})
        for (const double s : {-step, step})
          moved = improves((N + s * way).normalized()) || moved;
    }
  return std::abs(slowest) < 1e-10 * stiffest ? 0 : slowest;
}

std::vector<StudiedLaw> laws_to_study() {
  std::vector<StudiedLaw> laws;
  const auto add = [&](const char* label, const char* law, const char* constants, auto&& with) {
    for (const double poisson : {0.3, 0.45}) {
      const ElasticConstants elastic = ElasticConstants::from(17e6, poisson);
      laws.push_back({fmt::format("{} {}", label, poisson), law,
                      fmt::format("E = 17 MPa, nu = {}{}", poisson, constants), elastic.mu,
                      stress_of(with(elastic))});
    }
  };
  using E = ElasticConstants;
  add("Hencky", "hencky", "", [](const E& e) { return Hencky{e}; });
  add("Linear elastic", "linear_elastic", "", [](const E& e) { return LinearElastic{e}; });
  add("Saint Venant", "saint_venant_kirchhoff", "", [](const E& e) { return SaintVenantKirchhoff{e}; });
  add("Neo-Hookean", "neo_hookean", "", [](const E& e) { return NeoHookean{e}; });
  add("Mooney-Rivlin", "mooney_rivlin", ", c1 = c2", [](const E& e) {
    return MooneyRivlin{e.mu / 4, e.mu / 4, e.kappa};
  });
  add("Area term", "mooney_rivlin", ", c1 = 0", [](const E& e) {
    return MooneyRivlin{0, e.mu / 2, e.kappa};
  });

  const std::vector<OgdenTerm> terms = {{0.63e6, 1.3}, {0.0012e6, 5}, {-0.01e6, -2}};
  const double mu = Ogden{terms, 0}.linearised().mu;
  for (const double poisson : {0.45, 0.4995}) {
    const double kappa = mu * 2 * (1 + poisson) / (3 * (1 - 2 * poisson));
    const std::string constants =
        fmt::format("mu = 0.63, 0.0012, -0.01 MPa, alpha = 1.3, 5, -2, nu = {}", poisson);
    laws.push_back(
        {fmt::format("Ogden {}", poisson), "ogden", constants, mu, stress_of(Ogden{terms, kappa})});
    laws.push_back({fmt::format("Ogden, convex U {}", poisson), "ogden",
                    constants + ", U = kappa/2 (J - 1)^2", mu,
                    [kappa, shape = stress_of(Ogden{terms, 0})](const Mat3& F) -> Mat3 {
                      const Strain strain = Strain::of(F);
                      return shape(F) + kappa * (strain.J - 1) * strain.H;
                    }});
  }
  return laws;
}

const std::vector<std::string>& stretch_paths() {
  static const std::vector<std::string> names = {"uniaxial", "biaxial", "pure_shear", "volumetric"};
  return names;
}

Hyperbolicity study_hyperbolicity(const StudiedLaw& law) {
  Hyperbolicity study{law, 0, {}, {}, {}, {}};
  constexpr int grid = 36;
  const auto log_stretch = [](int i) { return log_range * (2.0 * i / grid - 1); };
  const auto lose = [&](double J) {
    if (J >= 1 - 1e-9)
      study.lost_swollen = std::min(study.lost_swollen.value_or(J), J);
    else
      study.lost_compressed = std::max(study.lost_compressed.value_or(J), J);
  };
  int lost = 0, all = 0;
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k) { // sorted triples stand for all their permutations
        const int weight = i == j && j == k ? 1 : i == j || j == k ? 3 : 6;
        const Vec3 stretches = Vec3(log_stretch(i), log_stretch(j), log_stretch(k)).array().exp();
        all += weight;
        if (slowest_at(law, stretches) < 0) {
          lost += weight;
          lose(stretches.prod());
        }
      }
  study.lost_fraction = static_cast<double>(lost) / all;
  for (const std::string& name : stretch_paths()) {
    study.paths.push_back(follow(law, name));
    for (const auto& loss : {study.paths.back().lost_below, study.paths.back().lost_above})
      if (loss)
        lose(loss->stretches.prod());
  }
  for (const char* region : {"plane_strain", "isochoric"})
    study.regions.push_back(trace(law, region));
  return study;
}

} // namespace tessera::solver
