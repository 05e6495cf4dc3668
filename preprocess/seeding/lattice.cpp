#include "preprocess/seeding/lattice.hpp"

#include "core/error.hpp"
#include "preprocess/seeding/column_scan.hpp"

#include <cmath>

namespace tessera::preprocess {
namespace {

/// What a kind is made of.
struct Pattern {
  Vec3 unit; ///< in spacings
  std::vector<Sublattice> parts;

  /// Whether some part has points with this index along an axis.
  bool has(int axis, std::int64_t index) const {
    for (const Sublattice& part : parts)
      if ((index - part.first[axis]) % part.step[axis] == 0)
        return true;
    return false;
  }
};

Pattern pattern_of(LatticeKind kind, int dimension) {
  switch (kind) {
  case LatticeKind::body_centred:
    return {Vec3::Constant(std::sqrt(1. / 3)), {{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {2, 2, 2}}}};
  case LatticeKind::hexagonal: {
    const Vec3 unit(0.5, std::sqrt(1. / 12), std::sqrt(2. / 3));
    if (dimension == 2)
      return {unit, {{{0, 0, 0}, {2, 6, 1}}, {{1, 3, 0}, {2, 6, 1}}}};
    return {unit,
            {{{0, 0, 0}, {2, 6, 2}}, {{1, 3, 0}, {2, 6, 2}}, {{0, 2, 1}, {2, 6, 2}}, {{1, 5, 1}, {2, 6, 2}}}};
  }
  default:
    return {Vec3::Ones(), {{{0, 0, 0}, {1, 1, 1}}}};
  }
}

} // namespace

Vec3 Lattice::whole_numbers(std::size_t i) const {
  const Vec3 at(index[i][0], index[i][1], index[i][2]);
  if (spec.kind != LatticeKind::hexagonal)
    return at;
  // Rows along (3, -3, 0), layers along (1, 1, 1); x and y are both even or both odd.
  return at.x() / 2 * Vec3(3, -3, 0) + at.y() / 2 * Vec3(1, 1, -2) + at.z() * Vec3(2, 2, 2);
}

Lattice lattice_frame(const Domain& domain, const LatticeSpec& spec) {
  require(domain.dimension == 3 || spec.kind != LatticeKind::body_centred,
          "a body-centred lattice needs a body in space", "particles",
          "choose a cubic or hexagonal lattice for a plane body");
  const Pattern pattern = pattern_of(spec.kind, domain.dimension);
  Lattice frame;
  frame.spec = spec;
  frame.unit = spec.spacing * pattern.unit;
  frame.counts = {1, 1, 1};
  for (int a = 0; a < domain.dimension; ++a) {
    const double unit = frame.unit[a], length = domain.upper[a] - domain.lower[a];
    // A face that falls short of a whole step by less than the band still gets its layer.
    const double band = lattice_band * spec.spacing;
    auto intervals = static_cast<std::int64_t>(std::floor((length + band) / unit));
    while (!pattern.has(a, intervals))
      --intervals;
    frame.origin[a] = (domain.lower[a] + domain.upper[a] - static_cast<double>(intervals) * unit) / 2;
    if (spec.shift[a] != 0) {
      const double period = unit * pattern.parts[0].step[a];
      frame.origin[a] += spec.shift[a] * period;
      frame.origin[a] += std::floor((domain.lower[a] - band - frame.origin[a]) / period) * period;
      intervals = static_cast<std::int64_t>(std::floor((domain.upper[a] + band - frame.origin[a]) / unit));
    }
    frame.counts[a] = static_cast<std::int32_t>(intervals) + 1;
  }
  return frame;
}

Lattice lattice_points(const Domain& domain, const CadTopology& cad, const LatticeSpec& spec) {
  Lattice lattice = lattice_frame(domain, spec);
  const Lattice frame = lattice;
  const BoundaryBands bands(domain, cad);
  for (const Sublattice& part : pattern_of(spec.kind, domain.dimension).parts)
    ColumnScan(bands, frame, part).emit(lattice);
  return lattice;
}

std::int64_t lattice_count(const Domain& domain, const CadTopology& cad, const LatticeSpec& spec) {
  return lattice_count(BoundaryBands(domain, cad), spec);
}

std::int64_t lattice_count(const BoundaryBands& bands, const LatticeSpec& spec) {
  const Lattice frame = lattice_frame(bands.domain(), spec);
  std::int64_t total = 0;
  for (const Sublattice& part : pattern_of(spec.kind, bands.domain().dimension).parts)
    total += ColumnScan(bands, frame, part).count();
  return total;
}

} // namespace tessera::preprocess
