#include "preprocess/seeding/random.hpp"

#include <algorithm>

namespace tessera::preprocess {

RandomPoints::RandomPoints(const Domain& domain, std::uint64_t seed) : domain_(&domain), bits_(seed) {
  double total = 0;
  volume_up_to_.reserve(domain.tets.size());
  for (std::size_t t = 0; t < domain.tets.size(); ++t)
    volume_up_to_.push_back(total += domain.tet_volume(t));
}

double RandomPoints::uniform() {
  return static_cast<double>(bits_() >> 11) * 0x1p-53;
}

Vec3 RandomPoints::next() {
  const double pick = uniform() * volume_up_to_.back();
  const auto at = std::upper_bound(volume_up_to_.begin(), volume_up_to_.end() - 1, pick);
  const auto& tet = domain_->tets[at - volume_up_to_.begin()];
  double s = uniform(), t = uniform(), u = uniform();
  // The cube s, t, u falls into six tetrahedra of equal volume; folds lay them onto s + t + u <= 1
  // (Rocchini and Cignoni, Generating random points in a tetrahedron, 2000).
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  if (t + u > 1) {
    const double old = u;
    u = 1 - s - t;
    t = 1 - old;
  } else if (s + t + u > 1) {
    const double old = u;
    u = s + t + u - 1;
    s = 1 - t - old;
  }
  const auto& X = domain_->vertices;
  const Vec3& a = X[tet[0]];
  return a + s * (X[tet[1]] - a) + t * (X[tet[2]] - a) + u * (X[tet[3]] - a);
}

} // namespace tessera::preprocess
