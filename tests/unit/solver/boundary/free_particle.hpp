/// One particle of its own between walls, stepped as a body's particles are.
#pragma once

#include "solver/boundary/wall.hpp"

#include <vector>

namespace tessera::solver {

template <int D>
class FreeParticle {
 public:
  FreeParticle(const Vec<D>& position, const Vec<D>& velocity, double rho, std::vector<Wall<D>> tools)
      : x{position}, p{rho * velocity}, impulse{Vec<D>::Zero()}, density(rho), walls(std::move(tools)) {}

  Vec<D> velocity() const { return p[0] / density; }

  /// The walls on the initial momentum; `dt` is the step to come.
  void start(double dt) { limit_by<D>(walls, x, p, density, time, dt, 1, impulse); }

  /// Heun's method under an acceleration, with the walls as Step calls them.
  void step(double dt, const Vec<D>& acceleration) {
    const std::vector<Vec<D>> x_n = x, p_n = p;
    for (const bool last : {false, true}) {
      std::vector<Vec<D>> R = {density * acceleration};
      std::vector<Vec<D>> force = {Vec<D>::Zero()};
      for (Wall<D>& wall : walls)
        wall.push(x, p, density, last ? time + dt : time, dt, 0.5, R, force);
      impulse[0] += 0.5 * dt * force[0];
      const Vec<D> x_next = x[0] + dt / density * p[0], p_next = p[0] + dt * R[0];
      x[0] = last ? Vec<D>((x_n[0] + x_next) / 2) : x_next;
      p[0] = last ? Vec<D>((p_n[0] + p_next) / 2) : p_next;
      if (last) {
        limit_by<D>(walls, x, p, density, time + dt, dt, 1, impulse);
      } else {
        const std::vector<Vec<D>> middle = {(x_n[0] + x[0]) / 2};
        limit_by<D>(walls, middle, p, density, time + dt / 2, dt / 2, 0.5, impulse);
      }
    }
    time += dt;
  }

  std::vector<Vec<D>> x, p, impulse;
  double density, time = 0;
  std::vector<Wall<D>> walls;
};

} // namespace tessera::solver
