#include "app/study/content_hash.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>

namespace tessera::app {

void ContentHash::mix(std::string_view bytes) {
  constexpr std::uint64_t prime = 0x100000001b3ULL;
  for (const char byte : bytes) {
    hash_ ^= static_cast<unsigned char>(byte);
    hash_ *= prime;
  }
}

void ContentHash::add(std::string_view text) {
  mix(fmt::format("{}:", text.size()));
  mix(text);
}

void ContentHash::add_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  require(in.good(), "cannot open the file", file.string(), "check the path and that it may be read");
  mix("file:");
  std::array<char, 65536> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0)
    mix({block.data(), static_cast<std::size_t>(in.gcount())});
}

std::string ContentHash::text() const {
  return fmt::format("{:016x}", hash_);
}

} // namespace tessera::app
