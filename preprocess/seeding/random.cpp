#include "preprocess/seeding/random.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tessera::preprocess {

RandomPoints::RandomPoints(const Domain& domain, std::uint64_t seed, SizeField size)
    : domain_(&domain), size_(std::move(size)), numbers_(seed) {
  double total = 0;
  if (size_) {
    parts_ = graded_parts(domain, size_);
    for (const GradedPart& part : parts_)
      share_up_to_.push_back(total += part.integral);
    return;
  }
  share_up_to_.reserve(domain.tets.size());
  for (std::size_t t = 0; t < domain.tets.size(); ++t)
    share_up_to_.push_back(total += domain.tet_volume(t));
}

std::size_t RandomPoints::pick() {
  const double share = numbers_.next() * share_up_to_.back();
  return std::upper_bound(share_up_to_.begin(), share_up_to_.end() - 1, share) - share_up_to_.begin();
}

Vec3 RandomPoints::in_tetrahedron(const std::array<Vec3, 4>& X) {
  double s = numbers_.next(), t = numbers_.next(), u = numbers_.next();
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
  Vec3 point = X[0] + s * (X[1] - X[0]) + t * (X[2] - X[0]) + u * (X[3] - X[0]);
  if (domain_->dimension == 2)
    point.z() = 0;
  return point;
}

Vec3 RandomPoints::next() {
  if (!size_) {
    const auto& [a, b, c, d] = domain_->tets[pick()];
    const auto& X = domain_->vertices;
    return in_tetrahedron({X[a], X[b], X[c], X[d]});
  }
  for (;;) {
    const GradedPart& part = parts_[pick()];
    const Vec3 point = in_tetrahedron(part.corners);
    if (numbers_.next() * part.most <= std::pow(size_(point), -domain_->dimension))
      return point;
  }
}

} // namespace tessera::preprocess
