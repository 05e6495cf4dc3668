#include "core/temporary_folder.hpp"

#include "core/error.hpp"

#include <cerrno>
#include <cstring>

#include <stdlib.h>

namespace tessera {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string name = ((error ? std::filesystem::path("/tmp") : parent) / "tessera-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw RunError(std::string("no temporary folder can be made: ") + std::strerror(errno), name,
                   "check that there is space, or set TMPDIR to a folder that may be written");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

} // namespace tessera
