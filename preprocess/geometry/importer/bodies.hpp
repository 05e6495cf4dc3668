/// Which of a file's bodies is meant.
#pragma once

#include "preprocess/geometry/importer/request.hpp"

#include <string>
#include <vector>

namespace tessera::importer {

/// One of several bodies, as people tell them apart.
struct Candidate {
  std::string name; ///< empty when the file gives none
  double measure;   ///< volume, or area of a plane body, in the file's unit
  Vec3 lower, upper;
};

/// Index of the body asked for (Request::solid). Throws InputError: several and none chosen (lists them), or
/// no such number. `noun` is what one of them is called.
std::size_t choose_body(const std::vector<Candidate>& candidates, const Request& request,
                        const std::string& noun);

/// Volume (dimension 3) or area (2) by OpenCASCADE; nothing when gmsh's own kernel made the entity, for it
/// knows none.
std::optional<double> kernel_measure(int dimension, int tag);

/// The CAD solid that is meant, the only visible entity of the model with what bounds it from here on.
int choose_solid(const Request& request);

/// Hides all but these entities and what bounds them: only they will be meshed.
void show_only(int dimension, const std::vector<int>& tags);

} // namespace tessera::importer
