/// What the importer is asked for, and its three ways to a Domain. All of it runs in the importer's own
/// process.
#pragma once

#include "preprocess/geometry/cad_file.hpp"
#include "preprocess/geometry/domain.hpp"

#include <string>

namespace tessera::importer {

struct Request {
  std::string file; ///< what to open
  std::string name; ///< what to call it in messages
  preprocess::CadFormat format;
  std::string step_unit;   ///< unit to have a STEP file's lengths in, as OpenCASCADE calls it
  double tolerance = 1e-3; ///< see GeometrySource
  double mesh_size = 0;    ///< in the units of the numbers; 0 for a tenth of the diagonal
};

/// All return lengths in the units of the numbers, and throw InputError for what is wrong with the file.
preprocess::Domain import_cad(const Request& request);  ///< .step, .brep, .geo
preprocess::Domain import_mesh(const Request& request); ///< .msh
preprocess::Domain import_stl(const Request& request);  ///< .stl

} // namespace tessera::importer
