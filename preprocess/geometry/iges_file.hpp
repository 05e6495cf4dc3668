/// What can be told of an IGES file from its text.
#pragma once

#include <string>
#include <string_view>

namespace tessera::preprocess {

/// Throws InputError naming `origin` unless the text begins with a start section and ends with a terminate
/// section, in lines of 80 columns (the ASCII form; compressed and binary files are not read).
void check_iges(std::string_view text, const std::string& origin);

/// Length unit of the global section: "m", "cm", "mm", "um", "in", "ft"; empty for one that is not listed, or
/// when the section cannot be read.
std::string iges_length_unit(std::string_view text);

} // namespace tessera::preprocess
