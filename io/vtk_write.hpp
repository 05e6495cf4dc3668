/// The one way this project writes VTK files: XML, raw appended data, LZ4, whole or not at all, with a
/// checksum.
#pragma once

#include <filesystem>

class vtkXMLWriter;

namespace tessera::io {

/// Has `writer` (its input set) make the file in memory and stores it atomically, followed by an XML comment
/// with a checksum, which other programs ignore. RunError naming the file.
void write_vtk(vtkXMLWriter& writer, const std::filesystem::path& file);

/// Throws InputError unless `file` opens, ends as an XML file of VTK does and agrees with its checksum (files
/// saved by other programs have none and pass). VTK's own readers return an empty data set and no error code
/// where a file is truncated, and crash on some that were altered.
void require_complete(const std::filesystem::path& file);

} // namespace tessera::io
