#include "solver/operators/spline_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace tessera::solver {
namespace {

template <int D>
using Place = std::array<std::int32_t, D>; // of a cell or a spline in its grid

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Those of `places` without repeats, ascending.
template <int D>
std::vector<Place<D>> distinct(std::vector<Place<D>> places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

template <int D>
std::int32_t number(const std::vector<Place<D>>& places, const Place<D>& place) {
  return static_cast<std::int32_t>(std::lower_bound(places.begin(), places.end(), place) - places.begin());
}

/// Products of `count` weights an axis, with the places they belong to, ascending from `first`.
template <int D, int count, class Use>
void over_products(const Place<D>& first, const std::array<std::array<double, count>, D>& weights,
                   Use&& use) {
  for (int k = 0; k < power(count, D); ++k) {
    Place<D> place = first;
    double weight = 1;
    for (int c = D - 1, rest = k; c >= 0; --c, rest /= count) {
      place[c] += rest % count;
      weight *= weights[c][rest % count];
    }
    use(k, place, weight);
  }
}

/// A grid's cells that hold particles, and the splines that reach them: cell i's begin at i on every axis.
template <int D>
struct Grid {
  std::vector<Place<D>> cells, splines;
  std::vector<double> stiffness; ///< of every cell: of fields that vary over a cell's length

  explicit Grid(std::vector<Place<D>> of_particles) : cells(distinct<D>(std::move(of_particles))) {
    stiffness.assign(cells.size(), 0);
    splines.reserve(cells.size() * power(3, D));
    for (const Place<D>& cell : cells)
      over_products<D, 3>(cell, {}, [&](int, const Place<D>& spline, double) { splines.push_back(spline); });
    splines = distinct<D>(std::move(splines));
  }

  /// One over each spline's stiffness: a cell's is shared among its splines by their means over it.
  std::vector<double> inverse_stiffness() const {
    std::array<std::array<double, 3>, D> mean;
    mean.fill({1.0 / 6, 2.0 / 3, 1.0 / 6});
    std::vector<double> sum(splines.size(), 0.0);
    for (std::size_t i = 0; i < cells.size(); ++i)
      over_products<D, 3>(cells[i], mean, [&](int, const Place<D>& spline, double weight) {
        sum[number<D>(splines, spline)] += weight * stiffness[i];
      });
    for (double& value : sum)
      value = 1 / value;
    return sum;
  }
};

template <int D>
Grid<D> coarser(const Grid<D>& fine) {
  const auto parent = [](Place<D> cell) {
    for (std::int32_t& i : cell)
      i /= 2;
    return cell;
  };
  std::vector<Place<D>> parents(fine.cells.size());
  std::transform(fine.cells.begin(), fine.cells.end(), parents.begin(), parent);
  Grid<D> coarse(std::move(parents));
  for (std::size_t i = 0; i < fine.cells.size(); ++i)
    coarse.stiffness[number<D>(coarse.cells, parent(fine.cells[i]))] += fine.stiffness[i] / power(2, 4);
  return coarse;
}

/// Interpolation with `entries` entries a row, which fill(row, columns, values) writes, ascending.
template <class Fill>
Eigen::SparseMatrix<double, Eigen::RowMajor> interpolation(std::int64_t rows, std::int64_t columns,
                                                           int entries, Fill&& fill) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(rows, columns);
  matrix.resizeNonZeros(rows * entries);
  matrix.outerIndexPtr()[rows] = static_cast<int>(rows * entries);
  for_each(rows, [&](std::int64_t row) {
    const auto first = static_cast<int>(row * entries);
    matrix.outerIndexPtr()[row] = first;
    fill(row, matrix.innerIndexPtr() + first, matrix.valuePtr() + first);
  });
  return matrix;
}

/// Values of the splines at particles, of which `at` is the place in units of the grid.
template <int D>
auto values(const std::vector<Vec<D>>& at, const std::vector<Place<D>>& cell, const Grid<D>& grid) {
  return interpolation(static_cast<std::int64_t>(at.size()), static_cast<std::int64_t>(grid.splines.size()),
                       power(3, D), [&](std::int64_t a, int* column, double* value) {
                         std::array<std::array<double, 3>, D> weights;
                         for (int c = 0; c < D; ++c) {
                           const double t = at[a][c] - cell[a][c];
                           weights[c] = {(1 - t) * (1 - t) / 2, 0.5 + t - t * t, t * t / 2};
                         }
                         over_products<D, 3>(cell[a], weights, [&](int k, const Place<D>& spline, double w) {
                           column[k] = number<D>(grid.splines, spline);
                           value[k] = w;
                         });
                       });
}

/// A spline is 1/4, 3/4, 3/4, 1/4 of those of the next finer grid: each of these has two above it an axis.
template <int D>
auto refinement(const Grid<D>& fine, const Grid<D>& coarse) {
  return interpolation(static_cast<std::int64_t>(fine.splines.size()),
                       static_cast<std::int64_t>(coarse.splines.size()), power(2, D),
                       [&](std::int64_t i, int* column, double* value) {
                         Place<D> first = fine.splines[i];
                         std::array<std::array<double, 2>, D> weights;
                         for (int c = 0; c < D; ++c) {
                           weights[c] = {first[c] % 2 == 0 ? 0.75 : 0.25, first[c] % 2 == 0 ? 0.25 : 0.75};
                           first[c] /= 2;
                         }
                         over_products<D, 2>(first, weights, [&](int k, const Place<D>& spline, double w) {
                           column[k] = number<D>(coarse.splines, spline);
                           value[k] = w;
                         });
                       });
}

/// Suits the finest of the particles, but a few in a hundred that are closer still. Coarser ones elsewhere
/// cost a few splines each.
template <int D>
double finest_spacing(const FitResidual<D>& K) {
  std::vector<double> distance(static_cast<std::size_t>(K.particles())); // to the neighbours, mean
  for_each(K.particles(), [&](std::int64_t a) {
    double sum = 0, count = 0;
    K.over_edges(a, [&](std::int32_t, double, const Vec<D>& R) {
      sum += R.norm();
      ++count;
    });
    distance[a] = sum / count;
  });
  const auto close = distance.begin() + K.particles() / 20;
  std::nth_element(distance.begin(), close, distance.end());
  return 1.25 * *close;
}

/// Positions in units of a grid's spacing from the lowest corner of all.
template <int D>
std::vector<Vec<D>> places(std::span<const Vec3> X, double spacing) {
  Vec<D> lower = X[0].head<D>();
  for (const Vec3& x : X)
    lower = lower.cwiseMin(x.head<D>());
  std::vector<Vec<D>> at(X.size());
  for_each(static_cast<std::int64_t>(X.size()),
           [&](std::int64_t a) { at[a] = (X[a].head<D>() - lower) / spacing; });
  return at;
}

/// What each particle's fit opposes to fields that vary over a grid's spacing. The number is measured: half
/// of it or twice as much costs up to a third more iterations.
template <int D>
std::vector<double> bending_stiffness(const FitResidual<D>& K, double spacing) {
  std::vector<double> stiffness(static_cast<std::size_t>(K.particles()));
  for_each(K.particles(), [&](std::int64_t a) {
    double sum = 0;
    K.over_edges(a, [&](std::int32_t, double w, const Vec<D>& R) {
      sum += w * std::pow(R.squaredNorm() / (spacing * spacing), 2);
    });
    stiffness[a] = 0.7 * sum;
  });
  return stiffness;
}

/// A row of a matrix times a field.
template <class Matrix, class Field>
auto product(const Matrix& S, std::int64_t row, const Field& x) {
  Eigen::Matrix<double, Field::RowsAtCompileTime, 1> sum;
  sum.setZero();
  for (typename Matrix::InnerIterator entry(S, row); entry; ++entry)
    sum += entry.value() * x.col(entry.col());
  return sum;
}

} // namespace

template <int D>
SplineLevels<D>::SplineLevels(const FitResidual<D>& K) : inverse_diagonal_(K.diagonal()) {
  const std::int64_t n = K.particles();
  const double largest = max_of(n, 0.0, [&](std::int64_t a) { return inverse_diagonal_[a]; });
  for (double& d : inverse_diagonal_)
    d = d > 1e-12 * largest ? 1 / d : 0; // few neighbours: a fit through all of them leaves nothing

  const double spacing = finest_spacing(K);
  const std::vector<Vec<D>> at = places<D>(K.positions(), spacing);
  std::vector<Place<D>> cell(at.size());
  for_each(n, [&](std::int64_t a) {
    for (int c = 0; c < D; ++c)
      cell[a][c] = static_cast<std::int32_t>(at[a][c]);
  });
  Grid<D> grid(cell);
  const std::vector<double> stiffness = bending_stiffness(K, spacing);
  for (std::int64_t a = 0; a < n; ++a)
    grid.stiffness[number<D>(grid.cells, cell[a])] += stiffness[a];

  Interpolation up = values<D>(at, cell, grid);
  for (;;) {
    const auto splines = static_cast<Eigen::Index>(grid.splines.size());
    Interpolation down = up.transpose();
    levels_.push_back({std::move(up), std::move(down), grid.inverse_stiffness(),
                       Field<D>(Field<D>::RowsAtCompileTime, splines),
                       Field<D>(Field<D>::RowsAtCompileTime, splines)});
    if (splines <= power(4, D))
      break;
    Grid<D> next = coarser<D>(grid);
    up = refinement<D>(grid, next);
    grid = std::move(next);
  }
}

template <int D>
void SplineLevels<D>::apply(const Field<D>& r, Field<D>& z) {
  const Field<D>* finer = &r;
  for (Level& level : levels_) {
    for_each(level.force.cols(),
             [&](std::int64_t i) { level.force.col(i) = product(level.down, i, *finer); });
    finer = &level.force;
  }
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    const bool coarsest = l + 1 == levels_.size();
    for_each(level.move.cols(), [&](std::int64_t i) {
      level.move.col(i) = level.D_inverse[i] * level.force.col(i);
      if (!coarsest)
        level.move.col(i) += product(levels_[l + 1].up, i, levels_[l + 1].move);
    });
  }
  for_each(r.cols(), [&](std::int64_t a) {
    z.col(a) = inverse_diagonal_[a] * r.col(a) + product(levels_[0].up, a, levels_[0].move);
  });
}

template class SplineLevels<2>;
template class SplineLevels<3>;

} // namespace tessera::solver
