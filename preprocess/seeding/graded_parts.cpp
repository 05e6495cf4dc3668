#include "preprocess/seeding/graded_parts.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

class Cutter {
 public:
  Cutter(const Domain& domain, const SizeField& size) : domain_(domain), size_(size) {}

  std::vector<GradedPart> cut(std::int64_t tet) const {
    std::array<Vec3, 4> X;
    std::array<double, 4> density;
    for (int k = 0; k < 4; ++k) {
      X[k] = domain_.vertices[domain_.tets[tet][k]];
      density[k] = density_at(X[k]);
    }
    std::vector<GradedPart> parts;
    cut(X, density, domain_.tet_volume(tet), parts);
    return parts;
  }

 private:
  double density_at(Vec3 X) const {
    if (domain_.dimension == 2)
      X.z() = 0;
    return std::pow(size_(X), -domain_.dimension);
  }

  double length(const Vec3& a, const Vec3& b) const {
    return domain_.dimension == 2 ? std::hypot(a.x() - b.x(), a.y() - b.y()) : (a - b).norm();
  }

  /// Halves across the longest edge until the density varies little; some way down in any case, so that no
  /// refinement is overlooked.
  void cut(const std::array<Vec3, 4>& X, const std::array<double, 4>& density, double volume,
           std::vector<GradedPart>& parts) const {
    const double centre = density_at((X[0] + X[1] + X[2] + X[3]) / 4);
    const auto [least, most] = std::minmax({density[0], density[1], density[2], density[3], centre});
    const bool even = most <= 1.4 * least;
    if (volume <= domain_.volume * 0x1p-22 || (even && volume <= domain_.volume * 0x1p-12)) {
      // Exact for quadratic densities.
      const double mean = (density[0] + density[1] + density[2] + density[3]) / 20 + 0.8 * centre;
      parts.push_back({X, volume * mean, 1.2 * most});
      return;
    }
    int a = 0, b = 1;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        if (length(X[i], X[j]) > length(X[a], X[b])) {
          a = i;
          b = j;
        }
    const Vec3 middle = (X[a] + X[b]) / 2;
    const double there = density_at(middle);
    for (const int replaced : {a, b}) {
      auto half = X;
      auto half_density = density;
      half[replaced] = middle;
      half_density[replaced] = there;
      cut(half, half_density, volume / 2, parts);
    }
  }

  const Domain& domain_;
  const SizeField& size_;
};

} // namespace

std::vector<GradedPart> graded_parts(const Domain& domain, const SizeField& size) {
  const Cutter cutter(domain, size);
  std::vector<std::vector<GradedPart>> of_tet(domain.tets.size());
  for_each_uneven(static_cast<std::int64_t>(domain.tets.size()),
                  [&](std::int64_t t) { of_tet[t] = cutter.cut(t); });
  std::vector<GradedPart> parts;
  for (const auto& some : of_tet)
    parts.insert(parts.end(), some.begin(), some.end());
  return parts;
}

double graded_volume(const Domain& domain, const SizeField& size) {
  if (!size)
    return domain.volume;
  double total = 0;
  for (const GradedPart& part : graded_parts(domain, size))
    total += part.integral;
  return total;
}

} // namespace tessera::preprocess
