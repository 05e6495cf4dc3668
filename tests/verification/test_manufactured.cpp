/// A manufactured solution of linear elasticity on an L-part of two-pass particles: tractions by formulas on
/// seven faces, rollers on the eighth, a body force inside. Second order in the displacement.
#include "preprocess/cloud/prepare.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/domains.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace tessera;
using namespace tessera::solver;

namespace {

constexpr double density = 1100, young = 17e6, nu = 0.3;
constexpr double mu = young / 2 / (1 + nu), lambda = young * nu / (1 + nu) / (1 - 2 * nu);
constexpr double k = 50, omega = 5000, amplitude = 1e-6;

std::string sum_of(double a, const std::string& x, double b, const std::string& y) {
  return fmt::format("{:.17g}*({})+{:.17g}*({})", a, x, b, y);
}

/// u = A sin(omega t) (sin k(X+Y) cos kZ, sin(k(X-Y)+1/2) cos kZ, cos kX sin kZ): neither u_z nor shear at Z
/// = 0.
struct Solution {
  const std::string s1 = "sin(50*(X+Y))", c1 = "cos(50*(X+Y))", s2 = "sin(50*(X-Y)+0.5)",
                    c2 = "cos(50*(X-Y)+0.5)", s3 = "sin(50*X)", c3 = "cos(50*X)", sz = "sin(50*Z)",
                    cz = "cos(50*Z)", swell = fmt::format("({}-{}+{})", c1, c2, c3);
  const std::string form[3] = {s1 + "*" + cz, s2 + "*" + cz, c3 + "*" + sz};

  static std::string in_time(double factor, const std::string& function, const std::string& what) {
    return fmt::format("{:.17g}*{}(5000*t)*({})", factor, function, what);
  }
  Formulas displacement() const { return vector(amplitude, "sin"); }
  Formulas velocity() const { return vector(amplitude * omega, "cos"); }
  /// tr sigma / 3
  Expression pressure() const {
    return Expression(in_time(amplitude * k * (lambda + 2 * mu / 3), "sin", cz + "*" + swell));
  }
  /// Of P, Pa.
  std::string stress(int i, int j) const {
    const std::string normal[3] = {c1, "-" + c2, c3};
    const std::string shear[3] = {fmt::format("-{}*{}", s2, sz), fmt::format("-({}+{})*{}", s1, s3, sz),
                                  fmt::format("{}*({}+{})", cz, c1, c2)}; // yz, xz, xy, engineering
    return in_time(amplitude * k, "sin",
                   i == j ? cz + "*(" + sum_of(2 * mu, normal[i], lambda, swell) + ")"
                          : fmt::format("{:.17g}*({})", mu, shear[3 - i - j]));
  }
  /// Acceleration of the mass that is wanted, (rho u'' - Div P) / rho.
  std::vector<Expression> body_force() const {
    const std::string gradient[3] = {fmt::format("{}*({}-{}-{})", cz, s2, s1, s3), // of div u, over A k^2
                                     fmt::format("-{}*({}+{})", cz, s1, s2),
                                     fmt::format("-{}*{}", sz, swell)};
    const double laplacian[3] = {3, 3, 2}; // over -A k^2
    std::vector<Expression> force;
    for (int i = 0; i < 3; ++i)
      force.emplace_back(in_time(amplitude, "sin",
                                 sum_of(laplacian[i] * k * k * mu / density - omega * omega, form[i],
                                        -(lambda + mu) * k * k / density, gradient[i])));
    return force;
  }

 private:
  Formulas vector(double factor, const std::string& function) const {
    const auto one = [&](int c) { return Expression(in_time(factor, function, form[c])); };
    return {one(0), one(1), one(2)};
  }
};

SceneSpec scene_of(const Solution& solution) {
  SceneSpec scene;
  scene.scheme = "consistent";
  scene.material = {"linear_elastic", density, young, nu, std::nullopt};
  scene.momentum_projection = false;
  scene.end_time = 4e-4;
  const Formulas v = solution.velocity();
  scene.initial.push_back({"all", v, std::nullopt});
  scene.boundary.push_back(
      {BoundaryCondition::Kind::body_force, "all", {true, true, true}, solution.body_force()});
  const auto load = [&](const std::string& face, int axis, double sign) {
    BoundaryCondition traction{BoundaryCondition::Kind::traction, face};
    for (int i = 0; i < 3; ++i)
      traction.values.emplace_back(fmt::format("{}*({})", sign, solution.stress(i, axis)));
    scene.boundary.push_back(std::move(traction));
  };
  load("xmin", 0, -1);
  load("xmax", 0, 1);
  load("ymin", 1, -1);
  load("ymax", 1, 1);
  load("zmax", 2, 1);
  load("notch_x", 0, 1);
  load("notch_y", 1, 1);
  scene.boundary.push_back({BoundaryCondition::Kind::sliding, "zmin"});
  scene.exact = {v, solution.pressure(), solution.displacement()};
  return scene;
}

struct Outcome {
  double spacing;
  ErrorNorms error;
};

Outcome outcome(int count, int relax_seeds) {
  preprocess::ParticleRequest request;
  request.arrangement = preprocess::Arrangement::voronoi;
  request.count = count;
  request.relax_seeds = relax_seeds;
  const ParticleCloud cloud =
      preprocess::prepare(test::l_domain(1, 0.015), request, Progress::silent()).cloud;
  return {cloud.spacing, *run(scene_of(Solution()), cloud, {}, Progress::silent()).error};
}

double order(const Outcome& coarse, const Outcome& fine, double ErrorNorms::*error) {
  return std::log(coarse.error.*error / fine.error.*error) / std::log(coarse.spacing / fine.spacing);
}

void converges(int relax_seeds, double displacement, double velocity) {
  const Outcome coarse = outcome(400, relax_seeds), middle = outcome(1000, relax_seeds),
                fine = outcome(2500, relax_seeds);
  EXPECT_GT(order(coarse, middle, &ErrorNorms::l2_displacement_relative), 1.7);
  EXPECT_GT(order(middle, fine, &ErrorNorms::l2_displacement_relative), 1.7);
  EXPECT_GT(order(coarse, fine, &ErrorNorms::l2_velocity_relative), 1.7);
  EXPECT_GT(order(coarse, fine, &ErrorNorms::l2_pressure_relative), 0.9); // first at the boundary
  EXPECT_LT(fine.error.l2_displacement_relative, displacement);
  EXPECT_LT(fine.error.l2_velocity_relative, velocity);
}

} // namespace

TEST(ManufacturedSolution, ConvergesOnRandomTwoPassClouds) {
  converges(0, 0.04, 0.06);
}

TEST(ManufacturedSolution, ConvergesOnRelaxedTwoPassClouds) {
  converges(20, 0.02, 0.025);
}
