#include "solver/operators/laplacian.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solver/operators/gradient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace tessera::solver {

template <int D>
Laplacian build_laplacian(std::span<const Vec3> X, std::span<const double> V, const Neighbours& neighbours,
                          const Kernel<D>& kernel) {
  const std::int64_t n = neighbours.size();
  std::vector<std::int64_t> blind(static_cast<std::size_t>(n), 0);
  Laplacian laplacian;
  laplacian.l.resize(static_cast<std::size_t>(neighbours.edges()));
  laplacian.sum.resize(static_cast<std::size_t>(n));
  for_each(n, [&](std::int64_t a) {
    // Lengths are scaled by the support so that the (D + 1)^2 system is well scaled in any unit.
    const double h = neighbours.support[a];
    using Unknowns = Eigen::Matrix<double, D + 1, 1>;
    using System = Eigen::Matrix<double, D + 1, D + 1>;
    System M = System::Zero();
    Unknowns right = Unknowns::Zero();
    const auto basis = [](const Vec<D>& R) {
      Unknowns q;
      for (int i = 0; i < D; ++i)
        q[i] = R[i];
      q[D] = R.squaredNorm();
      return q;
    };
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
      const std::int32_t b = neighbours.column[e];
      const Vec<D> R = (X[a] - X[b]).template head<D>() / h;
      const double volume = V[b] / std::pow(h, D);
      const double lap_W = kernel.laplacian(R.norm(), neighbours.pair_support(a, b) / h);
      const Unknowns q = basis(R);
      M += volume * q * q.transpose();
      right -= volume * lap_W * q;
    }
    right[D] += 2 * D;
    const Eigen::FullPivLU<System> lu(M);
    // rcond() of a matrix that is singular to the last bit is that of its regular part.
    if (!lu.isInvertible() || !(lu.rcond() > 1e-12)) {
      if (!(condition_number<D>(M.template topLeftCorner<D, D>()) < singular))
        throw InputError(fmt::format("particle {} at ({:.4g}, {:.4g}, {:.4g}) m has {} neighbours, too few "
                                     "for a Laplacian: they do not span {}",
                                     a, X[a][0], X[a][1], X[a][2], neighbours.count(a),
                                     D == 3 ? "space" : "the plane"),
                         "", "raise solver.support or solver.neighbours");
      blind[a] = 1;
      return;
    }
    const Unknowns alpha_beta = lu.solve(right);
    double sum = 0;
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
      const std::int32_t b = neighbours.column[e];
      const Vec<D> R = (X[a] - X[b]).template head<D>() / h;
      const double lap_W = kernel.laplacian(R.norm(), neighbours.pair_support(a, b) / h);
      laplacian.l[e] = V[b] / std::pow(h, D) * (lap_W + alpha_beta.dot(basis(R))) / (h * h);
      sum += laplacian.l[e];
    }
    laplacian.sum[a] = sum;
  });
  laplacian.blind = std::accumulate(blind.begin(), blind.end(), std::int64_t{0});
  return laplacian;
}

std::vector<double> transposed(const Laplacian& laplacian, std::span<const double> V,
                               const Neighbours& neighbours) {
  std::vector<double> t(laplacian.l.size());
  for_each(neighbours.size(), [&](std::int64_t a) {
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
      const std::int32_t b = neighbours.column[e];
      const auto begin = neighbours.column.begin();
      const auto back = std::lower_bound(begin + neighbours.row[b], begin + neighbours.row[b + 1], a);
      t[e] = V[b] * laplacian.l[back - begin] / V[a];
    }
  });
  return t;
}

template Laplacian build_laplacian<2>(std::span<const Vec3>, std::span<const double>, const Neighbours&,
                                      const Kernel<2>&);
template Laplacian build_laplacian<3>(std::span<const Vec3>, std::span<const double>, const Neighbours&,
                                      const Kernel<3>&);

} // namespace tessera::solver
