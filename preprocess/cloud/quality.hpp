/// What a cloud is worth, in numbers: the contents of quality.json.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tessera::preprocess {

/// SI units; keys of quality.json carry the same names.
struct Quality {
  std::int64_t particles = 0;
  int dimension = 3;
  double domain_volume = 0;
  double cad_volume = 0;
  double volume_sum = 0;
  double volume_error = 0;       ///< |volume_sum - domain_volume| / domain_volume
  double area_sum = 0;           ///< |sum A| / sum |A| of the cells' boundary: zero for a closed one
  double area_correction = 0;    ///< what balancing linear fields changed of A: sum |change| / sum |A|
  double area_imbalance = 0;     ///< what is left of sum A = 0 and sum X (x) A = (sum V) I, relative
  double first_moment_error = 0; ///< |sum V centroid - integral of X| / (V diagonal)
  double closure_error = 0;      ///< largest |sum of a cell's face areas| / sum of their magnitudes
  double spacing_min = 0;        ///< smallest distance to the nearest particle one sees, m
  double spacing_mean = 0;       ///< mean nearest-neighbour distance, m
  double spacing_ratio = 0;      ///< min / mean
  double spacing_min_over_h =
      0;                 ///< min / h, h the (V/N)^(1/d) that merging used (the lattice spacing on lattices)
  double volume_min = 0; ///< smallest subvolume / mean
  double volume_max = 0; ///< largest subvolume / mean
  std::int64_t corners = 0;                               ///< of the CAD model
  std::int64_t corner_particles = 0;                      ///< particles on them
  std::vector<std::pair<std::string, std::int64_t>> sets; ///< particles in each set
  std::uint64_t seed = 0;
  std::int64_t disconnected_cells = 0; ///< cells whose part of the body falls into several pieces
  std::int64_t inserted_particles = 0; ///< into material that no particle on its own side of a slot reached
  double stranded_volume = 0;          ///< part of the body owned by particles across a slot all the same
  std::int64_t hidden_pairs = 0;       ///< near each other, but a slot, hole or gap lies between them
  std::vector<std::pair<std::string, double>> seconds; ///< by stage
};

/// The text of quality.json.
std::string to_json(const Quality& quality);

} // namespace tessera::preprocess
