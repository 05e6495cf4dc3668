/// Files that are whole or not there: written to a temporary beside the target, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace tessera::io {

/// Writes `content` to `file` atomically; RunError naming the file and the system's reason when that fails.
void write_text(const std::filesystem::path& file, std::string_view content);

/// Calls write(temporary) and renames the temporary to `file` after checking that it exists and is not empty.
/// The temporary keeps `file`'s extension. Removes it on failure.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Creates the folder (and its parents) and proves that a file can be written in it. InputError otherwise.
void make_output_folder(const std::filesystem::path& folder);

} // namespace tessera::io
