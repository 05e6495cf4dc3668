/// A Domain as bytes: how the importer hands its result to the program that started it.
///
/// Layout, in the byte order of the machine (both ends run on the same one): the eight characters "TESSDOM2",
/// the number 0x01020304, then each member of Domain in the order of its declaration with its count in front,
/// and last a 64-bit FNV-1a hash of everything before it.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <string>
#include <string_view>

namespace tessera::preprocess {

std::string to_bytes(const Domain& domain);

/// Throws std::runtime_error saying what is wrong: short, long, altered, or not a domain at all. Never
/// allocates more than the bytes at hand can fill.
Domain from_bytes(std::string_view bytes);

} // namespace tessera::preprocess
