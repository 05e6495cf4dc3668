#include "solver/operators/two_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace tessera::solver {
namespace {

/// Boxes of a grid that hold particles, numbered as they come.
template <int D>
struct Grid {
  std::vector<std::int32_t> box;
  std::vector<Vec<D>> place; ///< of every particle in its box, from -1/2 to 1/2
  std::int64_t boxes = 0;

  explicit Grid(std::span<const Vec3> X) {
    constexpr double side = 4; // particles along a box
    Vec<D> lower = X[0].head<D>(), upper = lower;
    for (const Vec3& x : X) {
      lower = lower.cwiseMin(x.head<D>());
      upper = upper.cwiseMax(x.head<D>());
    }
    const double size = side * std::pow((upper - lower).prod() / static_cast<double>(X.size()), 1.0 / D);
    std::map<std::array<std::int64_t, D>, std::int32_t> numbers;
    for (const Vec3& x : X) {
      const Vec<D> at = (x.head<D>() - lower) / size;
      std::array<std::int64_t, D> key;
      Vec<D> in_box;
      for (int c = 0; c < D; ++c) {
        key[c] = static_cast<std::int64_t>(std::floor(at[c]));
        in_box[c] = at[c] - static_cast<double>(key[c]) - 0.5;
      }
      box.push_back(numbers.try_emplace(key, static_cast<std::int32_t>(numbers.size())).first->second);
      place.push_back(in_box);
    }
    boxes = static_cast<std::int64_t>(numbers.size());
  }
};

} // namespace

template <int D>
TwoLevel<D>& TwoLevel<D>::compute(const FitResidual<D>& K) {
  inverse_diagonal_ = K.diagonal().cwiseInverse();
  Grid<D> grid(K.positions());
  box_ = std::move(grid.box);
  boxes_ = grid.boxes;
  value_.resize(box_.size());
  for (std::size_t a = 0; a < box_.size(); ++a)
    value_[a] << 1, grid.place[a];

  // The energy of a field is the sum over all particles of what their fits leave of it: of each particle's
  // part only the boxes around it know.
  using Block = Eigen::Matrix<double, functions, functions>;
  std::map<std::pair<std::int32_t, std::int32_t>, Block> blocks;
  std::vector<std::int32_t> around;
  for (std::int64_t a = 0; a < K.particles(); ++a) {
    around.assign(1, box_[a]);
    K.over_edges(a, [&](std::int32_t b, double, const Vec<D>&) {
      if (std::find(around.begin(), around.end(), box_[b]) == around.end())
        around.push_back(box_[b]);
    });
    if (around.size() == 1)
      continue; // linear all around: nothing is left
    const auto n = static_cast<Eigen::Index>(functions * around.size());
    Eigen::MatrixXd rise = Eigen::MatrixXd::Zero(K.count(a), n);
    Eigen::MatrixXd R(K.count(a), D);
    Eigen::VectorXd weight(K.count(a));
    Eigen::Index row = 0;
    K.over_edges(a, [&](std::int32_t b, double w, const Vec<D>& R_ab) {
      const auto at = std::find(around.begin(), around.end(), box_[b]) - around.begin();
      rise.row(row).template segment<functions>(functions * at) += value_[b].transpose();
      rise.row(row).template head<functions>() -= value_[a].transpose();
      R.row(row) = R_ab.transpose();
      weight[row] = w;
      ++row;
    });
    const Eigen::MatrixXd weighted = weight.asDiagonal() * rise;
    const Eigen::MatrixXd slope = weighted.transpose() * R;
    const Eigen::MatrixXd energy =
        rise.transpose() * weighted - slope * K.inverse_moment(a) * slope.transpose();
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = 0; j < around.size(); ++j)
        blocks.try_emplace({around[i], around[j]}, Block::Zero()).first->second +=
            energy.template block<functions, functions>(functions * i, functions * j);
  }

  std::vector<Eigen::Triplet<double>> entries;
  double largest = 0;
  for (const auto& [at, block] : blocks)
    for (int i = 0; i < functions; ++i)
      for (int j = 0; j < functions; ++j) {
        entries.emplace_back(functions * at.first + i, functions * at.second + j, block(i, j));
        largest = std::max(largest, std::abs(block(i, j)));
      }
  // Linear fields have no energy, nor may functions of boxes with few particles: a little makes it definite.
  for (std::int64_t i = 0; i < functions * boxes_; ++i)
    entries.emplace_back(i, i, 1e-9 * largest);
  Eigen::SparseMatrix<double> matrix(functions * boxes_, functions * boxes_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  coarse_.compute(matrix);
  return *this;
}

template <int D>
Eigen::VectorXd TwoLevel<D>::solved(const Eigen::VectorXd& r) const {
  const auto n = static_cast<std::int64_t>(box_.size());
  const auto of = [&](std::int64_t a) { return r.segment<D>(D * a); };
  Eigen::MatrixXd rough = Eigen::MatrixXd::Zero(functions * boxes_, D);
  for (std::int64_t a = 0; a < n; ++a)
    rough.middleRows<functions>(functions * box_[a]) += value_[a] * of(a).transpose();
  const Eigen::MatrixXd smooth = coarse_.solve(rough);
  Eigen::VectorXd z(r.size());
  for_each(n, [&](std::int64_t a) {
    z.segment<D>(D * a) = inverse_diagonal_[a] * of(a) +
                          smooth.middleRows<functions>(functions * box_[a]).transpose() * value_[a];
  });
  return z;
}

template class TwoLevel<2>;
template class TwoLevel<3>;

} // namespace tessera::solver
