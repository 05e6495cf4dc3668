#include "preprocess/seeding/column_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::preprocess {
namespace {

constexpr double near_enough = 0.02;

/// Tries lattices of one kind and remembers the one whose count comes nearest.
class Search {
 public:
  Search(const BoundaryBands& bands, LatticeKind kind, std::int64_t count)
      : bands_(bands), kind_(kind), wanted_(static_cast<double>(count)) {}

  const FittedLattice& best() const { return best_; }
  double error() const { return error_; }
  void forget() { error_ = std::numeric_limits<double>::infinity(); }

  /// The count minus the one wanted.
  double attempt(double spacing, const Vec3& shift) {
    const LatticeSpec spec{kind_, spacing, shift};
    const std::int64_t count = lattice_count(bands_, spec);
    const double excess = static_cast<double>(count) - wanted_;
    const double error = std::abs(excess) / wanted_;
    if (error < error_) {
      best_ = {spec, count};
      error_ = error;
    }
    return excess;
  }

  /// Fewer points on wider lattices, on the whole: a spacing where the count passes the one wanted.
  double bisect(double fine, double coarse, const Vec3& shift) {
    while (coarse / fine > 1 + 1e-4) {
      const double middle = std::sqrt(fine * coarse);
      (attempt(middle, shift) > 0 ? fine : coarse) = middle;
    }
    return std::sqrt(fine * coarse);
  }

 private:
  const BoundaryBands& bands_;
  LatticeKind kind_;
  double wanted_;
  FittedLattice best_;
  double error_ = std::numeric_limits<double>::infinity();
};

/// Shifts that fill the unit cube evenly: multiples of the powers of 1/g with g^4 = g + 1 (Roberts 2018).
Vec3 spread_shift(int k, int dimension) {
  constexpr double g = 1.22074408460575947536;
  Vec3 shift(k / g, k / (g * g), dimension == 2 ? 0 : k / (g * g * g));
  return shift - shift.array().floor().matrix();
}

} // namespace

FittedLattice lattice_for_count(const Domain& domain, const CadTopology& cad, LatticeKind kind,
                                std::int64_t count) {
  const BoundaryBands bands(domain, cad);
  const Vec3 sides = domain.upper - domain.lower;
  Search search(bands, kind, count);

  const double typical = std::pow(domain.volume / static_cast<double>(count), 1. / domain.dimension);
  const double near = search.bisect(typical / 2, std::max(4 * typical, 2 * sides.maxCoeff()), Vec3::Zero());
  const FittedLattice plain = search.best();
  const double plain_error = search.error();

  // Spacings nearby that divide a side.
  search.forget();
  const Lattice frame = lattice_frame(domain, {kind, near, Vec3::Zero()});
  for (int axis = 0; axis < domain.dimension; ++axis) {
    const auto steps = static_cast<std::int64_t>(std::llround(sides[axis] / frame.unit[axis]));
    for (std::int64_t n = std::max<std::int64_t>(1, steps - 3); n <= steps + 3; ++n)
      search.attempt(near * sides[axis] / (static_cast<double>(n) * frame.unit[axis]), Vec3::Zero());
  }
  if (search.error() <= near_enough)
    return search.best();
  if (plain_error <= near_enough)
    return plain;

  search.attempt(plain.spec.spacing, plain.spec.shift);
  for (int axes = 1; axes < 1 << domain.dimension && search.error() > near_enough; ++axes)
    search.bisect(near / 1.3, near * 1.3, {axes & 1 ? 0.5 : 0, axes & 2 ? 0.5 : 0, axes & 4 ? 0.5 : 0});
  for (int k = 1; k <= 48 && search.error() > near_enough; ++k)
    search.bisect(near / 1.3, near * 1.3, spread_shift(k, domain.dimension));
  return search.best();
}

} // namespace tessera::preprocess
