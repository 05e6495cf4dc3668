/// A short name for what a run depends on.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tessera::app {

/// SHA-256 of pieces of text, each counted with its length, so that moving a letter from one to the next
/// changes it.
class ContentHash {
 public:
  void add(std::string_view text);
  /// The bytes of a file. RunError when it cannot be read.
  void add_file(const std::filesystem::path& file);
  /// The first sixteen hexadecimal digits.
  std::string text() const;

 private:
  std::string content_;
};

} // namespace tessera::app
