/// A tessellation with all it refers to, for tests.
#pragma once

#include "preprocess/seeding/random.hpp"
#include "preprocess/voronoi/cell_measures.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace tessera::test {

struct Tessellation {
  preprocess::Domain domain;
  preprocess::TetBody body;
  std::vector<Vec3> seeds; ///< scaled
  preprocess::DelaunayGraph graph;
  preprocess::RestrictedVoronoi voronoi;

  Tessellation(const preprocess::Domain& shape, const std::vector<Vec3>& X)
      : domain(shape),
        body(domain, preprocess::scaling_for(domain, std::pow(domain.volume / static_cast<double>(X.size()),
                                                              1.0 / shape.dimension))),
        seeds(scaled(X)), graph(preprocess::delaunay_graph(seeds)), voronoi(body, seeds, graph) {}
  Tessellation(const Tessellation&) = delete;
  Tessellation& operator=(const Tessellation&) = delete;

  double volume(double measured) const { return measured * body.scaling.volume(); }

 private:
  std::vector<Vec3> scaled(const std::vector<Vec3>& X) const {
    std::vector<Vec3> result;
    for (const Vec3& x : X)
      result.push_back(body.scaling.in(x));
    return result;
  }
};

/// Uniform in the body; in a slab moved to z = 0.
inline std::vector<Vec3> random_points(const preprocess::Domain& domain, int count, std::uint64_t seed = 7) {
  preprocess::RandomPoints random(domain, seed);
  std::vector<Vec3> X;
  for (int i = 0; i < count; ++i) {
    X.push_back(random.next());
    if (domain.dimension == 2)
      X.back().z() = 0;
  }
  return X;
}

} // namespace tessera::test
