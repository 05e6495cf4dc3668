// Settings for other files: values and tables of which only the text matters.

#include "app/case/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace tessera::app {
namespace {

std::string toml_text(const toml::node& node) {
  if (const toml::value<double>* number = node.as_floating_point())
    return fmt::format("{}", number->get()); // in as few digits as tell it apart
  std::ostringstream out;
  out << toml::toml_formatter(node);
  return out.str();
}

void append_assignments(const std::string& path, const toml::node& node, std::vector<std::string>& to) {
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    to.push_back(fmt::format("{}={}", path, toml_text(node)));
    return;
  }
  for (const auto& [key, value] : *table)
    append_assignments(fmt::format("{}.{}", path, key.str()), value, to);
}

} // namespace

std::vector<Table::Literal> Table::literals(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  std::vector<Literal> found;
  if (node == nullptr)
    return found;
  const auto add = [&](const std::string& entry, const toml::node& value) {
    if (value.is_table())
      wrong_type(entry, value, "a number, a word, true, false or a list of those");
    found.push_back({toml_text(value), value.value<std::string>().value_or(toml_text(value))});
  };
  if (const toml::array* list = node->as_array())
    for (std::size_t i = 0; i < list->size(); ++i)
      add(fmt::format("{}.{}", key, i), *list->get(i));
  else
    add(key, *node);
  if (found.empty())
    refuse(key, fmt::format("{} is empty", path_of(key)), "list one value or more");
  return found;
}

std::vector<std::string> Table::assignments() {
  std::vector<std::string> found;
  for (const std::string& key : keys())
    if (std::find(declared_.begin(), declared_.end(), key) == declared_.end()) {
      declared_.push_back(key);
      append_assignments(key, *table_->get(key), found);
    }
  return found;
}

std::vector<std::string> Table::keys() const {
  std::vector<std::string> names;
  if (table_ != nullptr)
    for (const auto& [key, value] : *table_)
      names.emplace_back(key.str());
  return names;
}

} // namespace tessera::app
