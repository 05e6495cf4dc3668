#include "preprocess/cloud/boundary_areas.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <Eigen/Cholesky>

#include <algorithm>

namespace tessera::preprocess {
namespace {

using Vec4 = Eigen::Matrix<double, 4, 1>;
using Mat4 = Eigen::Matrix<double, 4, 4>;
using Mat43 = Eigen::Matrix<double, 4, 3>; ///< a column for each component of A

/// Coordinates of order one about the middle of the owning particles, with the constant in front.
class Frame {
 public:
  explicit Frame(const ParticleCloud& cloud) : dimension_(cloud.dimension) {
    const std::int64_t n = cloud.size();
    const double total = sum(n, 0.0, [&](std::int64_t i) { return cloud.A[i].norm(); });
    middle_ = sum(n, Vec3(Vec3::Zero()),
                  [&](std::int64_t i) -> Vec3 { return cloud.A[i].norm() / total * cloud.X[i]; });
    size_ = max_of(n, 0, [&](std::int64_t i) { return (cloud.X[i] - middle_).norm(); });
  }
  Vec4 operator()(const Vec3& X) const {
    const Vec3 x = (X - middle_) / size_;
    return {1, x[0], x[1], x[2]};
  }
  double size() const { return size_; }
  /// Unknowns in use: the constant and the coordinates of the space.
  int terms() const { return dimension_ + 1; }

 private:
  int dimension_;
  Vec3 middle_;
  double size_;
};

/// What is missing: row 0 of the sum of A, row 1 + j of the sum of x_j A.
Mat43 defect(const ParticleCloud& cloud, const Frame& frame) {
  Mat43 missing = -sum(cloud.size(), Mat43(Mat43::Zero()),
                       [&](std::int64_t i) -> Mat43 { return frame(cloud.X[i]) * cloud.A[i].transpose(); });
  const double volume = sum(cloud.size(), 0.0, [&](std::int64_t i) { return cloud.V[i]; });
  for (int j = 0; j < cloud.dimension; ++j)
    missing(1 + j, j) += volume / frame.size();
  return missing;
}

} // namespace

double balance_areas(ParticleCloud& cloud) {
  const std::int64_t n = cloud.size();
  const std::vector<Vec3> before = cloud.A;
  const Frame frame(cloud);
  const int terms = frame.terms();
  // Minimising sum |change|^2 / |A| makes each change |A_a| (c + m.x_a): one small system for all components.
  const auto weight = [&](std::int64_t i) { return before[i].norm(); };
  const Mat4 moments = sum(n, Mat4(Mat4::Zero()), [&](std::int64_t i) -> Mat4 {
    const Vec4 x = frame(cloud.X[i]);
    return weight(i) * x * x.transpose();
  });
  const Eigen::MatrixXd system = moments.topLeftCorner(terms, terms);
  const Eigen::LDLT<Eigen::MatrixXd> solver(system);
  const auto pivots = solver.vectorD();
  require(pivots.minCoeff() > 1e-10 * pivots.maxCoeff(), "the particles that own boundary lie in one plane",
          "particles", "choose a spacing well below the body's size");
  // The second round takes away what rounding left of the first.
  for (int round = 0; round < 2; ++round) {
    Mat43 factors = Mat43::Zero();
    factors.topRows(terms) = solver.solve(Eigen::MatrixXd(defect(cloud, frame).topRows(terms)));
    for_each(n, [&](std::int64_t i) { cloud.A[i] += weight(i) * (factors.transpose() * frame(cloud.X[i])); });
  }
  const double change = sum(n, 0.0, [&](std::int64_t i) { return (cloud.A[i] - before[i]).norm(); });
  return change / sum(n, 0.0, weight);
}

double area_imbalance(const ParticleCloud& cloud) {
  const Frame frame(cloud);
  const Mat43 missing = defect(cloud, frame);
  const double area = sum(cloud.size(), 0.0, [&](std::int64_t i) { return cloud.A[i].norm(); });
  const double volume = sum(cloud.size(), 0.0, [&](std::int64_t i) { return cloud.V[i]; });
  return std::max(missing.row(0).norm() / area, missing.bottomRows(3).norm() * frame.size() / volume);
}

} // namespace tessera::preprocess
