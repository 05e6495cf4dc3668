/// The one way this project writes VTK files: XML, raw appended data, LZ4, whole or not at all.
#pragma once

#include <filesystem>

class vtkXMLWriter;

namespace tessera::io {

/// Has `writer` (its input set) make the file in memory and stores it atomically. RunError naming the file.
void write_vtk(vtkXMLWriter& writer, const std::filesystem::path& file);

/// Throws InputError unless `file` opens and ends as an XML file of VTK does. Costs nothing beside reading
/// it, and VTK's readers do not tell: of a truncated file they return an empty data set and no error code.
void require_complete(const std::filesystem::path& file);

} // namespace tessera::io
