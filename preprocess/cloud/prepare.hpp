/// From a Domain to the solver's particles: the whole of preprocessing after import.
#pragma once

#include "core/body_mesh.hpp"
#include "core/cell_mesh.hpp"
#include "core/particle_cloud.hpp"
#include "core/progress.hpp"
#include "preprocess/cloud/quality.hpp"
#include "preprocess/geometry/domain.hpp"
#include "preprocess/seeding/lattice.hpp"
#include "preprocess/seeding/size_field.hpp"
#include "preprocess/voronoi/backend.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tessera::preprocess {

/// Particles within tolerance of a plane (normal need not be of unit length).
struct PlaneSelector {
  Vec3 point, normal;
};
/// Particles inside a closed box.
struct BoxSelector {
  Vec3 lower, upper;
};
/// The one particle nearest to a point.
struct NearestSelector {
  Vec3 point;
};
/// A named set asked for by the case. Tolerance is in metres; 0 means 1e-3 of the spacing.
struct SetSelector {
  std::string name;
  std::variant<PlaneSelector, BoxSelector, NearestSelector> where;
  double tolerance = 0;
};

enum class Arrangement { lattice, voronoi, poisson };
enum class Subvolumes { voronoi, uniform };

struct ParticleRequest {
  Arrangement arrangement = Arrangement::lattice;
  Subvolumes subvolumes = Subvolumes::voronoi;
  LatticeKind lattice = LatticeKind::cubic;
  double spacing = 0;     ///< m, away from refinements; exactly one of spacing and count is positive
  std::int64_t count = 0; ///< particles wanted; reached within 2 % where the arrangement allows
  std::uint64_t seed = 1; ///< Mersenne twister
  double jitter = 0;   ///< inner particles of a lattice are moved by up to so many spacings along each axis
  double merge = 0.5;  ///< vertices of the first pass nearer than merge * (V/N)^(1/3) become one particle
  int relax_seeds = 0; ///< Lloyd sweeps on the seeds of a two-pass cloud
  int relax = 0;       ///< constrained Lloyd sweeps on the particles of an irregular cloud
  std::vector<Refinement> refine; ///< finer regions of an irregular cloud
  bool sizes_from_mesh = false;   ///< also: spacing in proportion to the edges of the domain's tetrahedra
  Backend backend = Backend::clipper;
  /// How far it is found out which particles see each other past slots and holes: in spacings on a lattice
  /// without jitter (0: 3.2), elsewhere in distances to the 30th visible neighbour (14th in the plane;
  /// 0: 1.5).
  double sight = 0;
  bool keep_cells = false; ///< also return the polyhedra
  std::vector<SetSelector> sets;
};

struct Prepared {
  ParticleCloud cloud;
  Quality quality;
  BodyMesh body;  ///< what was filled
  CellMesh cells; ///< empty unless keep_cells
};

/// InputError where the request cannot be met (no particle fits, a set is empty...).
Prepared prepare(const Domain& domain, const ParticleRequest& request, Progress& progress);

} // namespace tessera::preprocess
