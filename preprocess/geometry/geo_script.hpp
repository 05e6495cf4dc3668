/// A .geo file is a program in gmsh's language, which can run other programs and write files.
#pragma once

#include <string>
#include <string_view>

namespace tessera::preprocess {

struct GeoFinding {
  std::string what; ///< the word or construct; empty when nothing was found
  int line = 0;
};

/// First thing in the script that reaches beyond geometry: a word that runs programs, reads or writes files
/// or crafts names at run time, an unknown command (a word followed by a text or another word, which is how
/// gmsh writes its commands), a redirected Printf, or what would make gmsh's scanner and ours disagree (a
/// zero byte, a text of more than a thousand characters, an unclosed text or comment). Comments and texts
/// themselves are not searched.
GeoFinding forbidden_in_geo(std::string_view script);

} // namespace tessera::preprocess
