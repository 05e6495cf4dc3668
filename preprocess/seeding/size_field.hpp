/// How fine particles shall lie where: the spacing wanted at each point of a body, relative to the coarsest.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace tessera::preprocess {

/// Finer particles around a point or a named set of the CAD file (a group or a surface).
struct Refinement {
  std::variant<Vec3, std::string> around; ///< point (m) or name
  double factor = 0.5;                    ///< spacing there over the spacing away from it, 0 < factor <= 1
  double within = 0; ///< m: up to this distance the spacing is factor times the usual one
  double until = 0;  ///< m: from this distance on it is the usual one; linear between
};

/// Relative spacing at a point (m): in (0, 1], 1 where nothing refines. Empty: uniform.
using SizeField = std::function<double(const Vec3&)>;

/// The smallest of all refinements and, with `sizes_from_mesh`, of the mean length of the tetrahedra's edges
/// around a vertex over its largest, linear in between. Empty without any. Safe to call from several threads.
/// Throws InputError: a name that is no group or surface (with the nearest one), a factor out of (0, 1] or
/// below 0.01, distances negative or in the wrong order.
SizeField size_field(const Domain& domain, const std::vector<Refinement>& refine, bool sizes_from_mesh);

/// The integral of size^-dimension over the body, m^dimension; its volume where `size` is empty. N particles
/// of spacing h size fill it: N = graded volume / h^dimension.
double graded_volume(const Domain& domain, const SizeField& size);

} // namespace tessera::preprocess
