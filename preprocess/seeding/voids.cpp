#include "preprocess/seeding/voids.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

/// Corners of a simplex, in order.
template <class F>
void each_corner(const Simplex& s, F&& f) {
  for (int k = 0; k <= s.dimension; ++k)
    f(k);
}

} // namespace

LongestEdge::LongestEdge(const Simplex& simplex) {
  for (int i = 0; i <= simplex.dimension; ++i)
    for (int j = i + 1; j <= simplex.dimension; ++j) {
      const double length = (simplex.corners[i] - simplex.corners[j]).squaredNorm();
      if (length > squared) {
        squared = length;
        a = i;
        b = j;
      }
    }
}

void VoidSearch::run(const Simplex& simplex, const std::vector<Claimed>& claims, std::uint64_t key,
                     std::vector<Vec3>& found) {
  claims_ = claims;
  state_ = key;
  found_ = &found;
  search(simplex, 0, claims_.size());
}

void VoidSearch::run(const Cube& cube, double radius, const BodyBoxes& body,
                     const std::vector<Claimed>& claims, std::uint64_t key, std::vector<Vec3>& found) {
  claims_ = claims;
  state_ = key;
  found_ = &found;
  radius_ = radius;
  body_ = &body;
  search(cube, 0, claims_.size());
}

/// Steele, Lea and Flood 2014 (SplitMix64).
double VoidSearch::uniform() {
  std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

bool VoidSearch::covered(const Simplex& simplex, double least, std::size_t begin, std::size_t end) const {
  for (std::size_t k = begin; k < end; ++k) {
    const double reach = claims_[k].fraction * least;
    bool all = true;
    for (int c = 0; c <= simplex.dimension && all; ++c)
      all = (simplex.corners[c] - claims_[k].x).squaredNorm() < reach * reach;
    if (all)
      return true;
  }
  return false;
}

bool VoidSearch::covered(const Cube& cube, std::size_t begin, std::size_t end) const {
  for (std::size_t k = begin; k < end; ++k) {
    const Vec3 farthest = (cube.middle - claims_[k].x).cwiseAbs() + Vec3::Constant(cube.half);
    if (farthest.squaredNorm() < radius_ * radius_)
      return true;
  }
  return false;
}

void VoidSearch::narrow(const Vec3& middle, double around, double radius, std::size_t begin,
                        std::size_t end) {
  for (std::size_t k = begin; k < end; ++k) {
    const double reach = claims_[k].fraction * radius + around;
    if ((claims_[k].x - middle).squaredNorm() < reach * reach)
      claims_.push_back(Claimed(claims_[k]));
  }
}

bool VoidSearch::free(const Vec3& x, double radius, std::size_t begin, std::size_t end) const {
  for (std::size_t k = begin; k < end; ++k) {
    const double reach = claims_[k].fraction * radius;
    if ((x - claims_[k].x).squaredNorm() < reach * reach)
      return false;
  }
  return true;
}

void VoidSearch::search(const Simplex& simplex, std::size_t begin, std::size_t end) {
  const auto corners = simplex.radius.begin();
  const auto [least, most] = std::minmax_element(corners, corners + simplex.dimension + 1);
  if (covered(simplex, *least, begin, end))
    return;

  // Claims whose balls meet this part.
  Vec3 middle = Vec3::Zero();
  double radius = 0;
  each_corner(simplex, [&](int k) {
    middle += simplex.corners[k] / (simplex.dimension + 1);
    radius += simplex.radius[k] / (simplex.dimension + 1);
  });
  double around = 0;
  each_corner(simplex,
              [&](int k) { around = std::max(around, (simplex.corners[k] - middle).squaredNorm()); });
  around = std::sqrt(around);
  narrow(middle, around, *most, begin, end);
  const std::size_t next = claims_.size();

  const LongestEdge edge(simplex);
  if (edge.squared <= std::pow(grain_ * *least, 2)) {
    // Uniform in the simplex: gaps between sorted uniform numbers.
    std::array<double, 5> at{0, 1, 1, 1, 1};
    for (int k = 1; k <= simplex.dimension; ++k)
      at[k] = uniform();
    std::sort(at.begin(), at.begin() + simplex.dimension + 1);
    at[simplex.dimension + 1] = 1;
    Vec3 x = Vec3::Zero();
    each_corner(simplex, [&](int k) { x += (at[k + 1] - at[k]) * simplex.corners[k]; });
    for (const Vec3& p : {x, middle})
      if (free(p, radius, end, next)) {
        found_->push_back(p);
        break;
      }
  } else {
    Simplex half = simplex;
    const Vec3 between = (simplex.corners[edge.a] + simplex.corners[edge.b]) / 2;
    const double there = (simplex.radius[edge.a] + simplex.radius[edge.b]) / 2;
    for (const int replaced : {edge.a, edge.b}) {
      half.corners = simplex.corners;
      half.radius = simplex.radius;
      half.corners[replaced] = between;
      half.radius[replaced] = there;
      search(half, end, next);
    }
  }
  claims_.resize(end);
}

void VoidSearch::search(const Cube& cube, std::size_t begin, std::size_t end) {
  if (covered(cube, begin, end))
    return;
  const double around = std::sqrt(3.) * cube.half;
  narrow(cube.middle, around, radius_, begin, end);
  const std::size_t next = claims_.size();
  if (2 * around > grain_ * radius_) {
    each_octant(cube, [&](const Cube& octant) { search(octant, end, next); });
  } else {
    Vec3 x;
    for (int a = 0; a < 3; ++a)
      x[a] = cube.middle[a] + (2 * uniform() - 1) * cube.half;
    for (const Vec3& p : {x, cube.middle})
      if (free(p, radius_, end, next) && (cube.inside || body_->holds(p))) {
        found_->push_back(p);
        break;
      }
  }
  claims_.resize(end);
}

} // namespace tessera::preprocess
