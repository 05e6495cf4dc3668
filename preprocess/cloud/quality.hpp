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
  double area_sum = 0;           ///< |sum A| / sum |A|: zero for a closed boundary
  double first_moment_error = 0; ///< |sum V centroid - integral of X| / (V diagonal)
  double closure_error = 0;      ///< largest |sum of a cell's face areas| / sum of their magnitudes
  double spacing_min = 0;        ///< smallest nearest-neighbour distance, m
  double spacing_mean = 0;       ///< mean nearest-neighbour distance, m
  double spacing_ratio = 0;      ///< min / mean
  double spacing_min_over_h =
      0;                 ///< min / h, h the (V/N)^(1/3) that merging used (the lattice spacing on lattices)
  double volume_min = 0; ///< smallest subvolume / mean
  double volume_max = 0; ///< largest subvolume / mean
  std::int64_t corners = 0;                               ///< CAD corners, each of them a particle
  std::vector<std::pair<std::string, std::int64_t>> sets; ///< particles in each set
  std::uint64_t seed = 0;
  std::int64_t disconnected_cells = 0; ///< cells whose part of the body falls into several pieces
  std::vector<std::pair<std::string, double>> seconds; ///< by stage
};

/// The text of quality.json.
std::string to_json(const Quality& quality);

} // namespace tessera::preprocess
