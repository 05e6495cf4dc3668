/// A TOML file with the command line's overrides applied, and where each of its keys was written.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::app {

class Document {
 public:
  /// Reads at most 1 MiB of `file`, or of file/KIND.toml where it is a folder. InputError when the file
  /// cannot be read or is not TOML, or an override does not fit it.
  Document(const std::filesystem::path& file, const std::vector<std::string>& overrides,
           const std::string& kind = "case");

  const toml::table& root() const { return root_; }
  const std::filesystem::path& file() const { return file_; }
  const std::string& kind() const { return kind_; }

  /// Where the value of a dotted key ("wall.0.restitution") was written: "file:line:column", or the override
  /// that set it. The nearest enclosing table where the key itself is absent.
  std::string where(std::string_view path) const;
  /// Whether the command line set this very key.
  bool is_overridden(std::string_view path) const { return overrides_.contains(path); }
  /// The same for the key's own name instead of its value.
  std::string where_key(std::string_view path) const;

 private:
  void override_key(const std::string& assignment);
  std::string override_of(std::string_view path) const;
  std::string position(const toml::source_region& region) const;

  std::string kind_;
  std::filesystem::path file_;
  toml::table root_;
  std::map<std::string, std::string, std::less<>> overrides_; ///< dotted key -> the argument that set it
};

/// Text of a user as it may stand in a one-line message: quoted, shortened, without control characters.
std::string in_quotes(std::string_view text);

} // namespace tessera::app
