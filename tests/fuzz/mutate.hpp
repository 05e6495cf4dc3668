/// Files as they come out of bad copies, bad exporters and bad editors.
#pragma once

#include <cstdint>
#include <string>

namespace tessera::test {

/// The file with one or two faults in it: bytes flipped, its end or its middle missing, lines deleted,
/// doubled or swapped, digits and numbers changed. The same fault for the same seed, everywhere.
std::string mutate(const std::string& file, std::uint64_t seed);

} // namespace tessera::test
