/// A bar after its impact as a run would store it, without running it: a shape and fields that look like the
/// real ones.
#pragma once

#include "core/frame.hpp"
#include "core/particle_cloud.hpp"

#include <cmath>
#include <vector>

namespace tessera::test {

/// Cylinder of radius 3.2 mm and height 32 mm on a lattice of spacing 0.64 mm, its foot mushroomed by
/// `strength` (1: as after 80 microseconds).
struct TaylorBar {
  std::vector<Vec3> X;
  std::vector<double> displacement, velocity, plastic_strain, von_mises, pressure, stress, J;

  explicit TaylorBar(double strength = 1, double spacing = 0.64e-3) {
    const int rings = static_cast<int>(std::lround(3.2e-3 / spacing)),
              layers = static_cast<int>(std::lround(32e-3 / spacing));
    for (int k = 0; k <= layers; ++k)
      for (int j = -rings; j <= rings; ++j)
        for (int i = -rings; i <= rings; ++i)
          if (i * i + j * j <= rings * rings + 0.1)
            add({i * spacing, j * spacing, k * spacing}, strength);
  }

  void add(const Vec3& x, double strength) {
    const double foot = strength * std::exp(-x.z() / 5e-3);
    X.push_back(x);
    const Vec3 u{1.1 * foot * x.x(), 1.1 * foot * x.y(),
                 -10.5e-3 * strength * (1 - std::exp(-x.z() / 9e-3)) / 0.972};
    displacement.insert(displacement.end(), {u.x(), u.y(), u.z()});
    velocity.insert(velocity.end(), {30 * x.x() / 3e-3, 0, -20 * (1 - foot)});
    const double r = std::hypot(x.x(), x.y()) / 3.2e-3;
    plastic_strain.push_back(2.4 * foot * (1 - 0.35 * r * r));
    von_mises.push_back(1e8 + 5.5e8 * std::sqrt(std::max(foot, 0.0)));
    pressure.push_back(4e8 * foot * (1 - 1.7 * r * r));
    for (int c = 0; c < 6; ++c)
      stress.push_back(c < 3 ? -pressure.back() : 0);
    J.push_back(1 - pressure.back() / 1.3e11);
  }

  Frame at(double time) const {
    return {time,
            100,
            X,
            {{"Displacement", 3, displacement},
             {"Velocity", 3, velocity},
             {"PlasticStrain", 1, plastic_strain},
             {"VonMises", 1, von_mises},
             {"Pressure", 1, pressure},
             {"Stress", 6, stress},
             {"J", 1, J}}};
  }

  ParticleCloud cloud(double spacing = 0.64e-3) const {
    ParticleCloud cloud;
    cloud.spacing = spacing;
    cloud.domain_volume = 1;
    cloud.arrangement = "lattice";
    cloud.subvolumes = "voronoi";
    cloud.X = X;
    for (const Vec3& x : X) {
      const bool side = std::hypot(x.x(), x.y()) > 3.2e-3 - 0.5 * spacing,
                 end = x.z() < 1e-9 || x.z() > 32e-3 - 1e-9;
      cloud.V.push_back(std::pow(spacing, 3) * (side ? 0.55 : 1) * (end ? 0.5 : 1));
      cloud.A.push_back(Vec3::Zero());
      cloud.cad_dimension.push_back(3);
    }
    cloud.centroid = X;
    return cloud;
  }
};

} // namespace tessera::test
