/// Particle clouds made by hand, for tests and benchmarks of the solver alone.
#pragma once

#include "core/particle_cloud.hpp"

#include <functional>

namespace tessera::test {

/// nx x ny x nz points over the box [0, size], boundary included, with their exact Voronoi subvolumes (half
/// cells on faces, quarter cells on edges, eighths at corners) and areas. Dimension 2 when nz = 1. Sets: the
/// faces "x_min" ... "z_max", and "base" and "top" for those of the last axis.
ParticleCloud box_lattice(int nx, int ny, int nz, const Vec3& size);

/// The same points, each inner one moved by up to `shift` spacings in every direction (seeded). Subvolumes
/// are left as they were, so this is a cloud for operators, not for bodies.
ParticleCloud jittered(ParticleCloud cloud, double shift, unsigned seed);

/// Lattice points (i h, j h, k h) with i^2 + j^2 <= n^2, k = 0 ... layers - 1: n = 5 gives 81 a layer.
/// Uniform subvolumes of a cylinder of radius n h and height (layers - 1) h standing on z = 0. Set "base".
ParticleCloud cylinder_lattice(int n, int layers, double h);

} // namespace tessera::test
