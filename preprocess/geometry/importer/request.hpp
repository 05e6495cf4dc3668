/// What the importer is asked for: the program that wants a body writes it as arguments, the importer's
/// process reads them.
#pragma once

#include "preprocess/geometry/import.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tessera::importer {

struct Request {
  std::string file;        ///< what to open; empty for a shape
  std::string name;        ///< what to call it in messages
  std::string output;      ///< file for the Domain
  double metres = 1;       ///< metres in one unit of the numbers
  std::string cad_unit;    ///< unit to have a STEP file's lengths in, as OpenCASCADE calls it
  double tolerance = 1e-3; ///< see GeometrySource, as all that follow
  double mesh_size = 0;    ///< in the units of the numbers; 0 for a tenth of the diagonal
  int dimension = 3;
  int solid = 0;
  int close_holes = 0;
  bool background_sizes = false;
  std::optional<preprocess::ShapeSpec> shape; ///< lengths in the units of the numbers
};

/// "key=value" each, exact to the last bit.
std::vector<std::string> to_arguments(const Request& request);

/// Throws std::invalid_argument naming the argument that is none.
Request from_arguments(std::span<const char* const> arguments);

} // namespace tessera::importer
