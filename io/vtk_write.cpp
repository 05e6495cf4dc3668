#include "io/vtk_write.hpp"

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/vtk_messages.hpp"

#include <vtkErrorCode.h>
#include <vtkXMLWriter.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::io {
namespace {

constexpr std::string_view end_of_root = "</VTKFile>";
constexpr std::string_view comment = "<!-- fnv1a64 {:016x} -->\n";

/// Fowler-Noll-Vo hash (FNV-1a, 64 bits): not against forgers, but it misses no damage that happens by
/// itself.
class Checksum {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes)
      value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  std::string text() const { return fmt::format(fmt::runtime(comment), value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::string checksum_of_first(std::ifstream& in, std::streamoff count) {
  Checksum sum;
  std::vector<char> block(1 << 20);
  in.seekg(0);
  while (count > 0 && in) {
    in.read(block.data(), std::min<std::streamoff>(count, static_cast<std::streamoff>(block.size())));
    sum.add({block.data(), static_cast<std::size_t>(in.gcount())});
    count -= in.gcount();
  }
  return sum.text();
}

} // namespace

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
  std::string content = writer.GetOutputString();
  Checksum sum;
  sum.add(content);
  write_text(file, content += sum.text());
}

void require_complete(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError("cannot read: it is a folder", file.string(), "name the file in it");
  errno = 0;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in)
    throw InputError(fmt::format("cannot read: {}", std::strerror(errno)), file.string(), "check its name");
  const std::streamoff size = in.tellg(), start = std::max<std::streamoff>(0, size - 128);
  std::string tail(static_cast<std::size_t>(size - start), '\0');
  in.seekg(start);
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  const auto end = tail.rfind(end_of_root);
  require(in.good() && end != std::string::npos, "the file is truncated or not a VTK XML file", file.string(),
          "make it again");
  const std::size_t mark = tail.find("<!--", end);
  if (mark == std::string::npos &&
      tail.find_first_not_of(" \t\r\n", end + end_of_root.size()) == std::string::npos)
    return;
  const bool intact =
      mark != std::string::npos &&
      checksum_of_first(in, start + static_cast<std::streamoff>(mark)) == std::string_view(tail).substr(mark);
  require(intact, "the file is damaged: its checksum does not agree", file.string(), "make it again");
}

} // namespace tessera::io
