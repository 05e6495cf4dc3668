/// A folder for a moment's work.
#pragma once

#include <filesystem>

namespace tessera {

/// A folder nobody else can enter, under the system's temporary folder; gone with its contents at the end of
/// the scope. RunError when none can be made.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

} // namespace tessera
