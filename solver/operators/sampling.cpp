#include "solver/operators/sampling.hpp"

#include "core/error.hpp"
#include "solver/operators/gradient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace tessera::solver {
namespace {

constexpr double ill_conditioned = 1e3;
constexpr double largest_correction = 3; // magnitudes of the weights sum to at most one more
constexpr double first_reach = 2;
constexpr int rounds = 15;       // of growth by a tenth: fourfold
constexpr double outside = 1.25; // over the spacing at the nearest particle

/// Distances of the candidates from x, infinite where one is hidden from `from` (-1: none is).
template <int D>
std::vector<double> distances(const Vec<D>& x, std::span<const Vec3> X,
                              std::span<const std::int32_t> candidates, const HiddenPairs& hidden,
                              std::int64_t from) {
  std::vector<double> r(candidates.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] = from >= 0 && hidden.contains(from, candidates[i])
               ? std::numeric_limits<double>::infinity()
               : (X[candidates[i]].template head<D>() - x).norm();
  return r;
}

/// The k-th smallest (from 0).
double smallest(std::vector<double> r, std::size_t k) {
  std::nth_element(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(k), r.end());
  return r[k];
}

} // namespace

template <int D>
Sampling build_sampling(const Vec3& point, std::span<const Vec3> X, std::span<const double> V,
                        const HiddenPairs& hidden, const Kernel<D>& kernel) {
  std::vector<std::int32_t> all(X.size());
  std::iota(all.begin(), all.end(), 0);
  return build_sampling<D>(point, X, V, all, hidden, kernel);
}

template <int D>
Sampling build_sampling(const Vec3& point, std::span<const Vec3> X, std::span<const double> V,
                        std::span<const std::int32_t> candidates, const HiddenPairs& hidden,
                        const Kernel<D>& kernel) {
  const Vec<D> x = point.head<D>();
  const std::string name = fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) m", point[0], point[1], point[2]);
  require(x.allFinite(), name + " is not a place", "", "give finite coordinates");
  require(candidates.size() > 2 * D,
          fmt::format("values at a point need more than {} particles", candidates.size()), "",
          "ask for more particles");

  const std::vector<double> all = distances<D>(x, X, candidates, hidden, -1);
  const auto first = std::min_element(all.begin(), all.end()) - all.begin();
  const std::int32_t nearest = candidates[first];
  const Vec<D> X_nearest = X[nearest].template head<D>();
  const double reach = outside * smallest(distances<D>(X_nearest, X, candidates, hidden, nearest), 2 * D);
  require(std::isfinite(reach),
          fmt::format("particle {}, the nearest to {}, sees fewer than {} others", nearest, name, 2 * D), "",
          "ask for more particles");
  require(all[first] <= reach,
          fmt::format("{} lies outside the body: the nearest particle, {}, is {:.4g} m away, the cloud "
                      "reaches {:.4g} m there",
                      name, nearest, all[first], reach),
          "", "move it into the body (reference position, m)");

  const std::vector<double> r = distances<D>(x, X, candidates, hidden, nearest);
  double s = first_reach * smallest(r, D);
  for (int round = 0; round < rounds; ++round, s *= 1.1) {
    Sampling sampling{{}, {}, s};
    double total = 0;
    Vec<D> mean = Vec<D>::Zero();
    const auto offset = [&](std::int32_t b) -> Vec<D> { return (X[b].template head<D>() - x) / s; };
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (r[i] < s) {
        sampling.particle.push_back(candidates[i]);
        sampling.weight.push_back(V[candidates[i]] * kernel.value(r[i], s));
        total += sampling.weight.back();
        mean += sampling.weight.back() * offset(sampling.particle.back());
      }
    mean /= total;
    // (3.59b) takes moments about x; about the mean the same weights come without cancellation.
    Mat<D> M = Mat<D>::Zero();
    for (std::size_t i = 0; i < sampling.particle.size(); ++i) {
      sampling.weight[i] /= total;
      const Vec<D> q = offset(sampling.particle[i]) - mean;
      M += sampling.weight[i] * q * q.transpose();
    }
    if (!(condition_number<D>(M) < ill_conditioned))
      continue;
    const Vec<D> slope = M.inverse() * mean;
    // By Schwarz' inequality, sum |weight| <= 1 + sqrt(mean . slope).
    if (!(mean.dot(slope) < largest_correction * largest_correction))
      continue;
    for (std::size_t i = 0; i < sampling.particle.size(); ++i)
      sampling.weight[i] *= 1 - slope.dot(offset(sampling.particle[i]) - mean);
    return sampling;
  }
  throw InputError(fmt::format("the particles about {} do not span {} within {:.4g} m", name,
                               D == 3 ? "space" : "the plane", s),
                   "", "move it to where the body is thicker, or ask for more particles");
}

template Sampling build_sampling<2>(const Vec3&, std::span<const Vec3>, std::span<const double>,
                                    const HiddenPairs&, const Kernel<2>&);
template Sampling build_sampling<3>(const Vec3&, std::span<const Vec3>, std::span<const double>,
                                    const HiddenPairs&, const Kernel<3>&);
template Sampling build_sampling<2>(const Vec3&, std::span<const Vec3>, std::span<const double>,
                                    std::span<const std::int32_t>, const HiddenPairs&, const Kernel<2>&);
template Sampling build_sampling<3>(const Vec3&, std::span<const Vec3>, std::span<const double>,
                                    std::span<const std::int32_t>, const HiddenPairs&, const Kernel<3>&);

} // namespace tessera::solver
