/// What can be told of a CAD or mesh file from its text, before any CAD kernel sees it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::preprocess {

enum class CadFormat { step, iges, brep, geo, msh, stl, obj, ply };

/// STL, OBJ, PLY.
constexpr bool is_triangle_surface(CadFormat format) {
  return format == CadFormat::stl || format == CadFormat::obj || format == CadFormat::ply;
}

/// Format by the extension, checked against the first bytes of the file: gmsh takes what it does not
/// recognise for a .geo program. Throws InputError: missing, a folder, empty, unreadable, unknown extension,
/// not what it is called, cut off (STEP, IGES), a version of .msh other than 4.1 and 2.2.
CadFormat check_cad_file(const std::filesystem::path& file);

/// The whole file. Throws InputError when it cannot be read.
std::string read_text(const std::filesystem::path& file);

/// Length unit a STEP file declares: "m", "cm", "mm", "um", "in", "ft"; empty when it declares none, several,
/// or one that is not listed.
std::string step_length_unit(std::string_view text);

/// Names of a STEP file's ADVANCED_FACEs in the order of its only closed shell; empty strings for faces
/// without a name, an empty list when there is not exactly one such shell.
std::vector<std::string> step_face_names(std::string_view text);

} // namespace tessera::preprocess
