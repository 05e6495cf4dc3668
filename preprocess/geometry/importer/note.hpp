/// What the importer wants its user to know although all went well.
#pragma once

#include <string>
#include <string_view>

namespace tessera::importer {

/// Begins a line of the importer's output that is for the user; the rest is gmsh's talk.
inline constexpr std::string_view note_prefix = "tessera-import notes: ";

/// Prints one such line.
void note(const std::string& line);

} // namespace tessera::importer
