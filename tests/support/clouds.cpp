#include "tests/support/clouds.hpp"

#include <numbers>
#include <random>

namespace tessera::test {

ParticleCloud box_lattice(int nx, int ny, int nz, const Vec3& size) {
  ParticleCloud cloud;
  cloud.dimension = nz == 1 ? 2 : 3;
  cloud.arrangement = "lattice";
  cloud.subvolumes = "voronoi";
  const int n[3] = {nx, ny, nz};
  Vec3 h = Vec3::Zero();
  for (int c = 0; c < cloud.dimension; ++c)
    h[c] = size[c] / (n[c] - 1);
  cloud.spacing = h.head(cloud.dimension).minCoeff();
  const int last_axis = cloud.dimension - 1;
  for (int c = 0; c < cloud.dimension; ++c)
    for (const char* end : {"_min", "_max"})
      cloud.sets.push_back({std::string(1, "xyz"[c]) + end, {}, {}});
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int index[3] = {i, j, k};
        double volume = 1;
        Vec3 width = Vec3::Ones();
        int faces = 0;
        for (int c = 0; c < cloud.dimension; ++c) {
          const bool end = index[c] == 0 || index[c] == n[c] - 1;
          width[c] = end ? h[c] / 2 : h[c];
          volume *= width[c];
          faces += end;
        }
        const auto id = static_cast<std::int32_t>(cloud.X.size());
        Vec3 A = Vec3::Zero();
        for (int c = 0; c < cloud.dimension; ++c)
          for (const int end : {0, 1}) {
            if (index[c] != end * (n[c] - 1))
              continue;
            const Vec3 face = (2 * end - 1) * (volume / width[c]) * Vec3::Unit(c);
            ParticleSet& set = cloud.sets[static_cast<std::size_t>(2 * c + end)];
            set.particles.push_back(id);
            set.area.push_back(face);
            A += face;
          }
        cloud.A.push_back(A);
        cloud.X.emplace_back(i * h[0], j * h[1], k * h[2]);
        cloud.V.push_back(volume);
        cloud.domain_volume += volume;
        cloud.cad_dimension.push_back(static_cast<std::uint8_t>(cloud.dimension - faces));
      }
  cloud.centroid = cloud.X;
  for (const int end : {0, 1}) {
    ParticleSet named = cloud.sets[static_cast<std::size_t>(2 * last_axis + end)];
    named.name = end == 0 ? "base" : "top";
    cloud.sets.push_back(std::move(named));
  }
  return cloud;
}

ParticleCloud jittered(ParticleCloud cloud, double shift, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return 2 * static_cast<double>(random() >> 11) * 0x1.0p-53 - 1; };
  for (std::size_t a = 0; a < cloud.X.size(); ++a)
    for (int c = 0; c < cloud.dimension; ++c) {
      const double move = shift * cloud.spacing * uniform();
      if (cloud.cad_dimension[a] == cloud.dimension)
        cloud.X[a][c] += move;
    }
  cloud.arrangement = "voronoi";
  return cloud;
}

ParticleCloud cylinder_lattice(int n, int layers, double h) {
  ParticleCloud cloud;
  cloud.arrangement = "lattice";
  cloud.subvolumes = "uniform";
  cloud.spacing = h;
  ParticleSet base{"base", {}, {}};
  for (int k = 0; k < layers; ++k)
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i) {
        if (i * i + j * j > n * n)
          continue;
        if (k == 0)
          base.particles.push_back(static_cast<std::int32_t>(cloud.X.size()));
        cloud.X.emplace_back(i * h, j * h, k * h);
      }
  cloud.domain_volume = std::numbers::pi * n * n * h * h * (layers - 1) * h;
  const std::size_t N = cloud.X.size();
  cloud.V.assign(N, cloud.domain_volume / static_cast<double>(N));
  cloud.A.assign(N, Vec3::Zero());
  cloud.centroid = cloud.X;
  cloud.cad_dimension.assign(N, 3);
  cloud.sets = {base};
  return cloud;
}

} // namespace tessera::test
