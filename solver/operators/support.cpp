#include "solver/operators/support.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solver/operators/gradient.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tessera::solver {

Neighbours uniform_support(std::span<const Vec3> X, double radius, const HiddenPairs& hidden) {
  return find_neighbours(X, std::vector<double>(X.size(), radius), hidden);
}

template <int D>
Neighbours adaptive_support(std::span<const Vec3> X, std::span<const double> V, int neighbours,
                            const HiddenPairs& hidden, const Kernel<D>& kernel) {
  require(static_cast<std::size_t>(neighbours) < X.size(),
          fmt::format("{} neighbours asked for in a cloud of {} particles", neighbours, X.size()),
          "solver.neighbours", "ask for fewer, or for more particles");
  constexpr double ill_conditioned = 1e3;
  // The kernel vanishes at its radius: a little beyond the last neighbour, so that it counts.
  std::vector<double> support = distance_to_nearest(X, neighbours, hidden);
  for (std::size_t a = 0; a < support.size(); ++a) {
    require(std::isfinite(support[a]),
            fmt::format(
                "particle {} at ({:.4g}, {:.4g}, {:.4g}) m sees fewer than {} others past slots and holes", a,
                X[a][0], X[a][1], X[a][2], neighbours),
            "solver.neighbours", "ask for fewer, or for more particles");
    support[a] *= 1.02;
  }
  for (int round = 0; round < 10; ++round) {
    Neighbours found = find_neighbours(X, support, hidden);
    std::vector<std::uint8_t> grow(X.size(), 0);
    for_each(found.size(), [&](std::int64_t a) {
      grow[a] = !(condition_number<D>(moment_matrix<D>(a, X, V, found, kernel)) < ill_conditioned);
    });
    bool any = false;
    for (std::size_t a = 0; a < X.size(); ++a)
      if (grow[a]) {
        support[a] *= 1.1;
        any = true;
      }
    if (!any)
      return found;
  }
  return find_neighbours(X, std::move(support),
                         hidden); // build_gradient names the particle that is still singular
}

template Neighbours adaptive_support<2>(std::span<const Vec3>, std::span<const double>, int,
                                        const HiddenPairs&, const Kernel<2>&);
template Neighbours adaptive_support<3>(std::span<const Vec3>, std::span<const double>, int,
                                        const HiddenPairs&, const Kernel<3>&);

} // namespace tessera::solver
