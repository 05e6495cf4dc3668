/// Files as bytes: read whole, and told apart by their digest.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tessera::io {

/// All of a file. RunError naming it where it cannot be read.
std::string read_bytes(const std::filesystem::path& file);

/// SHA-256 of the bytes, 64 hexadecimal digits, as sha256sum prints it.
std::string sha256(std::string_view bytes);

} // namespace tessera::io
