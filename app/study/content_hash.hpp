/// A short name for what a run depends on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tessera::app {

/// 64-bit FNV-1a of pieces of text, each counted with its length, so that moving a letter from one to the
/// next changes it.
class ContentHash {
 public:
  void add(std::string_view text);
  /// The bytes of a file. InputError when it cannot be read.
  void add_file(const std::filesystem::path& file);
  /// Sixteen hexadecimal digits.
  std::string text() const;

 private:
  void mix(std::string_view bytes);
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

} // namespace tessera::app
