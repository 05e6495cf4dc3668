#include "solver/operators/gradient.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <fmt/format.h>

#include <limits>

namespace tessera::solver {

template <int D>
double condition_number(const Mat<D>& moment) {
  const Eigen::SelfAdjointEigenSolver<Mat<D>> eigen(moment, Eigen::EigenvaluesOnly);
  const double smallest = eigen.eigenvalues()[0], largest = eigen.eigenvalues()[D - 1];
  return smallest > 0 ? largest / smallest : std::numeric_limits<double>::infinity();
}

template <int D>
Mat<D> moment_matrix(std::int64_t a, std::span<const Vec3> X, std::span<const double> V,
                     const Neighbours& neighbours, const Kernel<D>& kernel) {
  Mat<D> M = Mat<D>::Zero();
  for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
    const std::int32_t b = neighbours.column[e];
    const Vec<D> R = (X[b] - X[a]).template head<D>();
    // grad W_b(X_a) = W'/r (X_a - X_b), so V_b grad W (x) (X_b - X_a) = -V_b W'/r R (x) R: positive definite.
    M -= V[b] * kernel.slope_over_r(R.norm(), neighbours.pair_support(a, b)) * R * R.transpose();
  }
  return M;
}

template <int D>
Gradient<D> build_gradient(std::span<const Vec3> X, std::span<const double> V, const Neighbours& neighbours,
                           const Kernel<D>& kernel) {
  const std::int64_t n = neighbours.size();
  const auto particles = static_cast<std::size_t>(n);
  std::vector<double> condition(particles);
  Gradient<D> gradient;
  gradient.omega.resize(static_cast<std::size_t>(neighbours.edges()));
  gradient.anchor.resize(particles, Gradient<D>::Anchor::Zero());
  gradient.B.resize(particles);
  gradient.inverse_moment.resize(particles);
  gradient.V.assign(V.begin(), V.end());
  for_each(n, [&](std::int64_t a) {
    Mat<D> moment = Mat<D>::Zero();
    for (std::int64_t e = neighbours.row[a]; e < neighbours.row[a + 1]; ++e) {
      const std::int32_t b = neighbours.column[e];
      const Vec<D> R = (X[b] - X[a]).template head<D>();
      // The product of both volumes first: the same bits from both ends.
      gradient.omega[e] =
          static_cast<float>(V[a] * V[b] * -kernel.slope_over_r(R.norm(), neighbours.pair_support(a, b)));
      moment += static_cast<double>(gradient.omega[e]) * R * R.transpose();
    }
    condition[a] = condition_number<D>(moment);
    if (!(condition[a] < singular))
      throw InputError(fmt::format("particle {} at ({:.4g}, {:.4g}, {:.4g}) m has {} neighbours within "
                                   "{:.4g} m, which do not span {}",
                                   a, X[a][0], X[a][1], X[a][2], neighbours.count(a), neighbours.support[a],
                                   D == 3 ? "space" : "the plane"),
                       "", "raise solver.support or solver.neighbours");
    gradient.anchor[a].col(0).template head<D>() = X[a].template head<D>();
    gradient.inverse_moment[a] = moment.inverse();
    gradient.B[a] = V[a] * gradient.inverse_moment[a];
  });
  gradient.worst_condition = max_of(n, 0.0, [&](std::int64_t a) { return condition[a]; });
  return gradient;
}

template double condition_number<2>(const Mat<2>&);
template double condition_number<3>(const Mat<3>&);
template Mat<2> moment_matrix<2>(std::int64_t, std::span<const Vec3>, std::span<const double>,
                                 const Neighbours&, const Kernel<2>&);
template Mat<3> moment_matrix<3>(std::int64_t, std::span<const Vec3>, std::span<const double>,
                                 const Neighbours&, const Kernel<3>&);
template Gradient<2> build_gradient<2>(std::span<const Vec3>, std::span<const double>, const Neighbours&,
                                       const Kernel<2>&);
template Gradient<3> build_gradient<3>(std::span<const Vec3>, std::span<const double>, const Neighbours&,
                                       const Kernel<3>&);

} // namespace tessera::solver
