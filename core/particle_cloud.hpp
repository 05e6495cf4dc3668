/// The particles a body is made of: what the preprocessor hands to the solver. Immutable once assembled.
#pragma once

#include "core/hidden_pairs.hpp"
#include "core/tensor.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tessera {

/// Particles that carry one name: a physical group, a CAD face or a selector of the case.
struct ParticleSet {
  std::string name;
  std::vector<std::int32_t> particles; ///< ascending, without repeats
  /// This set's share of each listed particle's boundary area vector, m^2, outward; empty for sets without
  /// surface.
  std::vector<Vec3> area;
};

/// Particles in the reference configuration, SI units. In plane strain (dimension 2) z = 0, V is an area per
/// unit thickness (m^2) and A a boundary length vector (m).
struct ParticleCloud {
  int dimension = 3;
  double spacing =
      0; ///< lattice spacing, or (domain volume / particles)^(1/dimension) on irregular clouds, m
  double domain_volume = 0; ///< volume of the tessellated body, m^3; the V sum to it
  std::uint64_t seed = 0;   ///< of the random generator; 0 where nothing was random
  std::string arrangement;  ///< "lattice", "voronoi" or "poisson"
  std::string subvolumes;   ///< "voronoi" (exact clipped cells) or "uniform" (volume / particles)

  std::vector<Vec3> X;   ///< positions, m
  std::vector<double> V; ///< subvolumes, m^3
  /// Outward boundary area vectors, m^2; zero inside. Sum A = 0 and sum X (x) A = (sum V) I exactly: what the
  /// exact boundary integrals satisfy holds for the particles' own positions too.
  std::vector<Vec3> A;
  std::vector<Vec3> centroid; ///< of the subvolumes, m
  std::vector<std::uint8_t>
      cad_dimension; ///< 0 corner, 1 edge, 2 face, 3 inside (2-D: 0 corner, 1 edge, 2 inside)
  std::vector<ParticleSet> sets;
  /// Pairs within `sight` that cannot see each other: the way between their cells' centroids leaves the body.
  HiddenPairs hidden;
  /// Up to which distance each particle's hidden pairs are listed, m. Empty: nobody looked, all see all.
  std::vector<double> sight;

  std::int64_t size() const { return static_cast<std::int64_t>(X.size()); }

  /// The set of that name; InputError with the nearest name and the list of sets where there is none. `where`
  /// is the place that asks for it, for the message.
  const ParticleSet& set(const std::string& name, const std::string& where = "") const;

  /// Throws InputError naming `origin` unless all arrays agree in length, all numbers are finite, every V is
  /// positive and every set's indices are in range.
  void validate(const std::string& origin) const;
};

/// The candidate nearest to `word` by edit distance, or empty when none is close: for "did you mean".
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

} // namespace tessera
