#include "io/vtk_write.hpp"

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/vtk_messages.hpp"

#include <vtkErrorCode.h>
#include <vtkXMLWriter.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace tessera::io {

// In memory first: VTK's stream to disk would say that writing failed but not why.
void write_vtk(vtkXMLWriter& writer, const std::filesystem::path& file) {
  const VtkMessages messages;
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToLZ4();
  writer.SetHeaderTypeToUInt64();
  writer.WriteToOutputStringOn();
  const bool written = writer.Write() == 1 && writer.GetErrorCode() == vtkErrorCode::NoError;
  if (!written)
    throw RunError(fmt::format("cannot write: {}", messages.last()), file.string(), "");
  write_text(file, writer.GetOutputString());
}

void require_complete(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError("cannot read: it is a folder", file.string(), "name the file in it");
  errno = 0;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in)
    throw InputError(fmt::format("cannot read: {}", std::strerror(errno)), file.string(), "check its name");
  const std::streamoff size = in.tellg();
  std::string tail(static_cast<std::size_t>(std::min<std::streamoff>(size, 64)), '\0');
  in.seekg(size - static_cast<std::streamoff>(tail.size()));
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  require(in.good() && tail.find("</VTKFile>") != std::string::npos,
          "the file is truncated or not a VTK XML file", file.string(), "make it again");
}

} // namespace tessera::io
