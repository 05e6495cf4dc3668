#include "preprocess/geometry/importer/note.hpp"

#include <cstdio>

namespace tessera::importer {

void note(const std::string& line) {
  std::printf("\n%.*s%s\n", static_cast<int>(note_prefix.size()), note_prefix.data(), line.c_str());
  std::fflush(stdout);
}

} // namespace tessera::importer
