/// CAD and mesh files to a Domain, read by gmsh in a child process.
///
/// The importer is a program of its own (tessera-import, beside the main program): a crash, a runaway or a
/// flood of memory in gmsh or OpenCASCADE ends the child and becomes an InputError here.
#pragma once

#include "core/progress.hpp"
#include "preprocess/geometry/domain.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera::preprocess {

/// A body described by numbers instead of a file: the name of one of known_shapes() and its lengths in m, in
/// the order of ShapeKind::lengths.
struct ShapeSpec {
  std::string name;
  std::vector<std::vector<double>> lengths;
};

/// A shape this program can build itself. Boxes, plates and profiles begin at the origin, cylinders, tubes
/// and spheres are centred on it, their axis is z with the base at z = 0. A hole goes through the middle of
/// its plate along z. Profiles lie in xy: an l_part has arms of size[0] along x and size[1] along y, a t_part
/// a flange of width size[0] on top of a web, size[1] high together; both are `thickness` thick.
struct ShapeKind {
  struct Length {
    std::string name; ///< key of the case file
    int components;   ///< 1, or the dimension for `size`
  };
  std::string name;
  int dimension;
  std::vector<Length> lengths;
  /// Names of its sets, in their order. Flat outer faces are x_min, x_max, y_min, y_max, z_min, z_max (left,
  /// right, bottom, top in the plane); round bodies have bottom, top, side (the outer face) and bore (the
  /// inner). plate_with_hole adds hole, l_part the faces inner_x and inner_y (normal to x and y) of its
  /// inside corner, t_part web_left and web_right, and flange_under for both undersides of its flange.
  std::vector<std::string> surfaces;
};

/// 3-D: box, cylinder, sphere, tube, plate_with_hole, l_part, t_part. 2-D: rectangle, disc, ring,
/// plate_with_hole, l_part, t_part.
const std::vector<ShapeKind>& known_shapes();

/// Either a file or a shape.
struct GeometrySource {
  std::filesystem::path file; ///< .step/.stp, .iges/.igs, .brep, .geo, .msh (4.1, 2.2), .stl, .obj, .ply
  std::string unit; ///< what one unit of the file is: "m", "cm", "mm", "um", "in"; STEP and IGES say
                    ///< so themselves, and what they say counts (with a note where it differs)
  std::optional<ShapeSpec> shape{}; ///< instead of `file` and `unit`
  int dimension = 3;                ///< 2: the plane surfaces of the file, in the plane z = const
  bool trust = false;               ///< a .geo file may run programs; refused unless trusted
  int solid = 0; ///< which solid of a file with several, counted from 1; 0: there must be only one
  /// Holes of a triangle surface (STL, OBJ, PLY) with at most this many edges are closed; 0: none is.
  int close_holes = 0;
  /// The mesh follows the background size field of the .geo file (needed by particles that take their sizes
  /// from the mesh).
  bool background_sizes = false;
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
