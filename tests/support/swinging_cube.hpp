/// A cube that swings in its first mode of pressure waves, with its closed form, (5.1).
#pragma once

#include "solver/physics/materials/elastic_constants.hpp"
#include "solver/scene/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace tessera::test {

/// The unit cube (E = 17 MPa, nu = 0.3, 1100 kg/m^3) to a quarter of its period: u = 5e-4 cos(w t) m with the
/// mode m, w = sqrt(3)/2 pi c, c the pressure wave speed.
inline solver::SceneSpec swinging_cube(const std::string& scheme) {
  using namespace solver;
  SceneSpec scene;
  scene.scheme = scheme;
  scene.material = {"linear_elastic", 1100, 17e6, 0.3, std::nullopt};
  scene.end_time = 0.004;
  const ElasticConstants elastic = ElasticConstants::from(17e6, 0.3);
  const double omega = std::sqrt(3.0) / 2 * M_PI * std::sqrt(elastic.pressure_wave_modulus() / 1100);
  const std::string x = "(_pi*X/2)", y = "(_pi*Y/2)", z = "(_pi*Z/2)";
  const auto times = [&](const std::string& factor) {
    return Formulas{Expression(fmt::format("{}*sin{}*cos{}*cos{}", factor, x, y, z)),
                    Expression(fmt::format("{}*cos{}*sin{}*cos{}", factor, x, y, z)),
                    Expression(fmt::format("{}*cos{}*cos{}*sin{}", factor, x, y, z))};
  };
  scene.initial.push_back({"all", std::nullopt, times("5e-4")});
  scene.exact = ExactSolution{times(fmt::format("-5e-4*{0:.17g}*sin({0:.17g}*t)", omega)),
                              Expression(fmt::format("{:.17g}*cos({:.17g}*t)*cos{}*cos{}*cos{}",
                                                     5e-4 * 1.5 * M_PI * elastic.kappa, omega, x, y, z)),
                              times(fmt::format("5e-4*cos({:.17g}*t)", omega))};
  for (const std::string axis : {"x", "y", "z"}) {
    scene.boundary.push_back({BoundaryCondition::Kind::sliding, fmt::format("{}_min", axis)});
    scene.boundary.push_back({BoundaryCondition::Kind::skew_symmetric, fmt::format("{}_max", axis)});
  }
  return scene;
}

} // namespace tessera::test
