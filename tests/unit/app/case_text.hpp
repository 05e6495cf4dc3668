/// Case files for tests: a complete one, variations of it, and the message reading it gives.
#pragma once

#include "app/case/case.hpp"
#include "core/temporary_folder.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::app {

/// A complete valid case; keys one a line.
extern const std::string complete_case;

/// complete_case with the first occurrence of `from` replaced by `to`; `from` must occur.
std::string with(const std::string& from, const std::string& to);

struct CaseFolder : TemporaryFolder {
  /// Writes a file in it and returns its path.
  std::filesystem::path file(const std::string& name, const std::string& text) const;
};

/// Reads `text` as "case.toml" of a temporary folder.
Case read_text_case(const std::string& text, const std::vector<std::string>& overrides = {});

/// The one-line message of the InputError that reading `text` throws, with the folder's name cut off
/// ("case.toml:3:1"); "no error" when there is none.
std::string message(const std::string& text, const std::vector<std::string>& overrides = {});

} // namespace tessera::app
