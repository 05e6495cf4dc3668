/// CAD and mesh files to a Domain, read by gmsh in a child process.
///
/// The importer is a program of its own (tessera-import, beside the main program): a crash, a runaway or a
/// flood of memory in gmsh or OpenCASCADE ends the child and becomes an InputError here.
#pragma once

#include "core/progress.hpp"
#include "preprocess/geometry/domain.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace tessera::preprocess {

struct GeometrySource {
  std::filesystem::path file; ///< .step/.stp, .brep, .geo, .msh (4.1, 2.2), .stl
  std::string unit;   ///< what one unit of the file is: "m", "cm", "mm", "um", "in"; STEP converts to it
  bool trust = false; ///< a .geo file may run programs; refused unless trusted
  double tolerance =
      1e-3;             ///< largest |mesh volume - CAD volume| / CAD volume: curved faces are refined to it
  double mesh_size = 0; ///< largest tetrahedron edge, m; 0: a tenth of the bounding box's diagonal
  double seconds = 120; ///< time limit of the import
  std::uint64_t bytes = std::uint64_t{4} << 30; ///< memory limit of the import
};

/// Metres in one `unit`; InputError listing the units known otherwise.
double metres_per_unit(const std::string& unit);

/// Reads, tessellates and checks. Notes the unit, bounding box and both volumes on `progress`.
/// Throws InputError: file missing, unreadable, no volume in it, surface open, time or memory limit reached.
Domain import_geometry(const GeometrySource& source, Progress& progress);

} // namespace tessera::preprocess
