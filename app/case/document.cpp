#include "app/case/document.hpp"

#include "app/case/nesting.hpp"
#include "core/error.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file = std::size_t{1} << 20;

fs::path file_of(const fs::path& given, const std::string& kind) {
  std::error_code failed;
  if (!fs::is_directory(given, failed))
    return given;
  const fs::path inside = given / (kind + ".toml");
  require(fs::exists(inside, failed), fmt::format("the {0} is a folder without a {0}.toml", kind),
          given.string(), fmt::format("give the {} file itself", kind));
  return inside;
}

std::string read_text(const fs::path& file, const std::string& kind) {
  std::ifstream in(file, std::ios::binary);
  require(in.good(), fmt::format("cannot open the {} file", kind), file.string(),
          "check the path and that it may be read");
  std::string text(largest_file + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  require(!in.bad(), fmt::format("cannot read the {} file", kind), file.string(),
          "check that it is a text file");
  require(text.size() <= largest_file, fmt::format("the {} file is larger than 1 MiB", kind), file.string(),
          fmt::format("give a TOML {}, not a mesh or a cloud", kind));
  return text;
}

toml::table parse(const std::string& text, const std::string& origin) {
  refuse_deep_nesting(text, origin);
  try {
    return toml::parse(text, origin);
  } catch (const toml::parse_error& e) {
    const auto at = e.source().begin;
    throw InputError(fmt::format("not valid TOML: {}", e.description()),
                     fmt::format("{}:{}:{}", origin, at.line, at.column), "correct the line");
  }
}

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t dot = path.find('.');
    parts.emplace_back(path.substr(0, dot));
    if (dot == std::string_view::npos)
      return parts;
    path.remove_prefix(dot + 1);
  }
}

std::optional<std::size_t> index_of(const std::string& part) {
  std::size_t index = 0;
  const auto [end, failed] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (failed != std::errc{} || end != part.data() + part.size())
    return std::nullopt;
  return index;
}

/// The node a part of a path names inside `parent`, or null.
const toml::node* child(const toml::node& parent, const std::string& part) {
  if (const toml::table* table = parent.as_table())
    return table->get(part);
  if (const toml::array* array = parent.as_array())
    if (const auto index = index_of(part))
      return array->get(*index);
  return nullptr;
}

/// A TOML value; words that are not one stand for themselves, so that a shell needs no quotes inside quotes.
toml::table value_of(const std::string& text, const std::string& argument) {
  refuse_deep_nesting(text, argument);
  try {
    toml::table parsed = toml::parse("value = " + text, argument);
    if (parsed.size() == 1)
      return parsed;
  } catch (const toml::parse_error&) {
    // a bare word
  }
  require(!text.empty() && text.find_first_of("[]{}\"'") == std::string::npos, "the value is not valid TOML",
          argument, "write --set key=value with a number, true, false, a word or a TOML list");
  toml::table word;
  word.insert("value", text);
  return word;
}

} // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string shown(text.substr(0, longest));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      c = '?';
  return fmt::format("'{}{}'", shown, text.size() > longest ? "..." : "");
}

Document::Document(const fs::path& file, const std::vector<std::string>& overrides, const std::string& kind)
    : kind_(kind), file_(file_of(file, kind)) {
  root_ = parse(read_text(file_, kind), file_.string());
  for (const std::string& assignment : overrides)
    override_key(assignment);
}

void Document::override_key(const std::string& assignment) {
  const std::string argument = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  require(equals != std::string::npos && equals > 0, "an override needs a key and a value", argument,
          "write --set key=value, for example --set particles.seed=7");
  const std::string path = assignment.substr(0, equals);
  const std::vector<std::string> parts = split(path);
  require(parts.size() <= 8, "the key is too deep", argument, "no key of a case lies deeper than four");
  for (const std::string& part : parts)
    require(!part.empty() && part.size() <= 64, "the key has an empty or overlong part", argument,
            "write --set key=value, for example --set particles.seed=7");
  toml::table value = value_of(assignment.substr(equals + 1), argument);

  toml::node* at = &root_;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    const bool last = i + 1 == parts.size();
    if (toml::table* table = at->as_table()) {
      if (last) {
        table->insert_or_assign(part, std::move(*value.get("value")));
      } else {
        if (table->get(part) == nullptr)
          table->insert(part, toml::table{});
        at = table->get(part);
      }
    } else if (toml::array* array = at->as_array()) {
      const auto index = index_of(part);
      require(index && *index <= array->size(), fmt::format("{} is not an entry of a list", in_quotes(part)),
              argument, fmt::format("give its number from 0 to {} (that one adds an entry)", array->size()));
      if (last) {
        if (*index == array->size())
          array->push_back(std::move(*value.get("value")));
        else
          array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(*index),
                         std::move(*value.get("value")));
      } else {
        if (*index == array->size())
          array->push_back(toml::table{});
        at = array->get(*index);
      }
    } else {
      throw InputError(fmt::format("the case has a plain value before {}", in_quotes(part)), argument,
                       "only tables and lists have keys inside them");
    }
  }
  overrides_[path] = argument;

  // The two ways to say how many particles: the one asked for here replaces the file's.
  for (const auto& [one, other] : {std::pair{"spacing", "count"}, std::pair{"count", "spacing"}})
    if (path == std::string("particles.") + one && !overrides_.contains(std::string("particles.") + other))
      root_["particles"].as_table()->erase(other);
}

std::string Document::override_of(std::string_view path) const {
  std::string found;
  for (const auto& [key, argument] : overrides_) {
    const bool inside = path == key || (path.starts_with(key) && path[key.size()] == '.');
    if (inside)
      found = argument;
  }
  return found;
}

std::string Document::position(const toml::source_region& region) const {
  if (region.begin.line == 0)
    return file_.string();
  return fmt::format("{}:{}:{}", file_.string(), region.begin.line, region.begin.column);
}

std::string Document::where(std::string_view path) const {
  if (const std::string argument = override_of(path); !argument.empty())
    return argument;
  if (path.empty())
    return file_.string();
  const toml::node* at = &root_;
  std::string reached;
  for (const std::string& part : split(path)) {
    const toml::node* next = child(*at, part);
    if (next == nullptr)
      break;
    reached += (reached.empty() ? "" : ".") + part;
    at = next;
  }
  if (at == &root_)
    return file_.string();
  if (at->source().begin.line == 0) // a table that exists only through an override inside it
    for (const auto& [key, argument] : overrides_)
      if (key.starts_with(reached))
        return argument;
  return position(at->source());
}

std::string Document::where_key(std::string_view path) const {
  if (const std::string argument = override_of(path); !argument.empty())
    return argument;
  const std::size_t dot = path.rfind('.');
  const std::string_view parent = dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
  const std::string_view name = dot == std::string_view::npos ? path : path.substr(dot + 1);
  const toml::node* at = &root_;
  if (!parent.empty())
    for (const std::string& part : split(parent)) {
      at = child(*at, part);
      if (at == nullptr)
        return where(path);
    }
  if (const toml::table* table = at->as_table())
    if (const auto entry = table->find(name); entry != table->cend() && entry->first.source().begin.line != 0)
      return position(entry->first.source());
  return where(path);
}

} // namespace tessera::app
