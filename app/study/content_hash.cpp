#include "app/study/content_hash.hpp"

#include "io/bytes.hpp"

#include <fmt/format.h>

namespace tessera::app {

void ContentHash::add(std::string_view text) {
  content_ += fmt::format("{}:", text.size());
  content_ += text;
}

void ContentHash::add_file(const std::filesystem::path& file) {
  add("file");
  add(io::sha256(io::read_bytes(file)));
}

std::string ContentHash::text() const {
  return io::sha256(content_).substr(0, 16);
}

} // namespace tessera::app
