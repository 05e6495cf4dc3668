#include "app/case/table.hpp"

#include "core/error.hpp"
#include "core/particle_cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tessera::app {
namespace {

std::string type_name(const toml::node& node) {
  switch (node.type()) {
  case toml::node_type::table:
    return "a table";
  case toml::node_type::array:
    if (node.is_array_of_tables())
      return "a list of tables";
    return node.as_array()->empty() ? "an empty list" : fmt::format("a list of {}", node.as_array()->size());
  case toml::node_type::string:
    return "text in quotes";
  case toml::node_type::integer:
  case toml::node_type::floating_point:
    return "a number";
  case toml::node_type::boolean:
    return "true or false";
  default:
    return "a date or time";
  }
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > 64)
    return "";
  const std::string nearest = nearest_name(word, candidates);
  return nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest);
}

} // namespace

Table::Table(const Document& document) : Table(document, &document.root(), "") {}

Table::Table(const Document& document, const toml::table* table, std::string path)
    : document_(&document), table_(table), path_(std::move(path)) {}

const toml::node* Table::declare(const std::string& key) {
  declared_.push_back(key);
  return table_ == nullptr ? nullptr : table_->get(key);
}

const toml::node* Table::declare_wanted(const std::string& key) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    missing_.push_back(key);
  return node;
}

bool Table::has(const std::string& key) const {
  return table_ != nullptr && table_->contains(key);
}

bool Table::is_text(const std::string& key) const {
  return has(key) && table_->get(key)->is_string();
}

bool Table::is_table(const std::string& key) const {
  return has(key) && table_->get(key)->is_table();
}

bool Table::is_list(const std::string& key) const {
  return has(key) && table_->get(key)->is_array();
}

void Table::refuse(const std::string& key, const std::string& what, const std::string& remedy) const {
  throw InputError(what, document_->where(path_of(key)), remedy);
}

void Table::wrong_type(const std::string& key, const toml::node& node, const char* wanted) const {
  refuse(key, fmt::format("{} is {}", path_of(key), type_name(node)), fmt::format("it must be {}", wanted));
}

double Table::number_in(const std::string& key, const toml::node& node, Range range) const {
  if (!node.is_number())
    wrong_type(key, node, "a number");
  const double x = *node.value<double>();
  if (!std::isfinite(x))
    refuse(key, fmt::format("{} is {}", path_of(key), x), "it must be a finite number");
  if (!range.holds(x))
    refuse(key, fmt::format("{} is {}", path_of(key), x), fmt::format("it must be {}", range.rule));
  return x;
}

std::string Table::text_in(const std::string& key, const toml::node& node) const {
  if (!node.is_string())
    wrong_type(key, node, "text in quotes");
  return *node.value<std::string>();
}

std::string Table::one_of(const std::string& key, const std::string& word,
                          const std::vector<std::string>& allowed) const {
  if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
    refuse(key, fmt::format("{} is {}", path_of(key), in_quotes(word)),
           fmt::format("{}known: {}", did_you_mean(word, allowed), fmt::join(allowed, ", ")));
  return word;
}

Vec3 Table::vector_in(const std::string& key, const toml::node& node) const {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 3)
    wrong_type(key, node, "a list of three numbers");
  Vec3 x;
  for (int i = 0; i < 3; ++i)
    x[i] = number_in(fmt::format("{}.{}", key, i), *list->get(static_cast<std::size_t>(i)), any_number);
  return x;
}

double Table::number(const std::string& key, Range range) {
  const toml::node* node = declare_wanted(key);
  return node == nullptr ? 0 : number_in(key, *node, range);
}

std::optional<double> Table::optional_number(const std::string& key, Range range) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    return std::nullopt;
  return number_in(key, *node, range);
}

double Table::number_or(const std::string& key, double otherwise, Range range) {
  return optional_number(key, range).value_or(otherwise);
}

std::int64_t Table::integer_or(const std::string& key, std::int64_t otherwise, std::int64_t lowest,
                               std::int64_t highest) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    return otherwise;
  const double x = number_in(key, *node, any_number);
  const auto whole = node->value<std::int64_t>(); // also of 2e3
  if (!whole || static_cast<double>(*whole) != x || *whole < lowest || *whole > highest)
    refuse(key, fmt::format("{} is {}", path_of(key), x),
           fmt::format("it must be a whole number from {} to {}", lowest, highest));
  return *whole;
}

bool Table::boolean_or(const std::string& key, bool otherwise) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    return otherwise;
  if (!node->is_boolean())
    wrong_type(key, *node, "true or false");
  return *node->value<bool>();
}

std::string Table::text(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  return node == nullptr ? "" : text_in(key, *node);
}

std::string Table::text_or(const std::string& key, const std::string& otherwise) {
  const toml::node* node = declare(key);
  return node == nullptr ? otherwise : text_in(key, *node);
}

std::string Table::choice(const std::string& key, const std::vector<std::string>& allowed) {
  const toml::node* node = declare_wanted(key);
  return node == nullptr ? allowed.front() : one_of(key, text_in(key, *node), allowed);
}

std::string Table::choice_or(const std::string& key, const std::string& otherwise,
                             const std::vector<std::string>& allowed) {
  const toml::node* node = declare(key);
  return node == nullptr ? otherwise : one_of(key, text_in(key, *node), allowed);
}

std::vector<std::string> Table::choices(const std::string& key, const std::vector<std::string>& allowed) {
  const toml::node* node = declare_wanted(key);
  if (node == nullptr)
    return {};
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty())
    wrong_type(key, *node, "a list of words such as [\"x\", \"y\"]");
  std::vector<std::string> words;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string entry = fmt::format("{}.{}", key, i);
    words.push_back(one_of(entry, text_in(entry, *list->get(i)), allowed));
    if (std::count(words.begin(), words.end(), words.back()) > 1)
      refuse(entry, fmt::format("{} lists '{}' twice", path_of(key), words.back()), "name each once");
  }
  return words;
}

std::string Table::name(const std::string& key) {
  const std::string word = text(key);
  const bool good = word.size() <= 64 && std::all_of(word.begin(), word.end(), [](char c) {
                      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
                    });
  if (has(key) && (!good || word.empty() || word.front() == '.'))
    refuse(key, fmt::format("{} is {}", path_of(key), in_quotes(word)),
           "a name has 1 to 64 letters, digits, '_', '-' and '.' and does not start with a dot");
  return word;
}

Vec3 Table::vector(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  return node == nullptr ? Vec3::Zero() : vector_in(key, *node);
}

std::optional<Vec3> Table::optional_vector(const std::string& key) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    return std::nullopt;
  return vector_in(key, *node);
}

std::vector<double> Table::numbers(const std::string& key, int count, Range range) {
  const toml::node* node = declare_wanted(key);
  std::vector<double> values(static_cast<std::size_t>(count), 0.0);
  if (node == nullptr)
    return values;
  const toml::array* list = node->as_array();
  if (list == nullptr || list->size() != values.size())
    wrong_type(key, *node, fmt::format("a list of {} numbers", count).c_str());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = number_in(fmt::format("{}.{}", key, i), *list->get(i), range);
  return values;
}

std::vector<double> Table::number_list(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  if (node == nullptr)
    return {};
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty())
    wrong_type(key, *node, "a list of numbers such as [1.5, -2]");
  std::vector<double> values;
  for (std::size_t i = 0; i < list->size(); ++i)
    values.push_back(number_in(fmt::format("{}.{}", key, i), *list->get(i), any_number));
  return values;
}

std::string Table::formula_in(const std::string& key, const toml::node& node) const {
  if (node.is_number())
    return fmt::format("{}", number_in(key, node, any_number));
  if (!node.is_string())
    wrong_type(key, node, "a number or a formula in quotes");
  return *node.value<std::string>();
}

std::array<std::string, 3> Table::formulas_in(const std::string& key, const toml::node& node) const {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 3)
    wrong_type(key, node, "a list of three numbers or formulas");
  std::array<std::string, 3> formulas;
  for (std::size_t i = 0; i < 3; ++i)
    formulas[i] = formula_in(fmt::format("{}.{}", key, i), *list->get(i));
  return formulas;
}

std::string Table::formula(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  return node == nullptr ? "0" : formula_in(key, *node);
}

std::array<std::string, 3> Table::formulas(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  return node == nullptr ? std::array<std::string, 3>{"0", "0", "0"} : formulas_in(key, *node);
}

std::vector<Vec<2>> Table::points(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  if (node == nullptr)
    return {};
  const toml::array* list = node->as_array();
  constexpr const char* wanted = "a list of two or more points such as [[0, 0], [1, 0.5]]";
  if (list == nullptr || list->size() < 2)
    wrong_type(key, *node, wanted);
  std::vector<Vec<2>> points;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string entry = fmt::format("{}.{}", key, i);
    const toml::array* pair = list->get(i)->as_array();
    if (pair == nullptr || pair->size() != 2)
      wrong_type(entry, *list->get(i), "two numbers [x, y]");
    points.emplace_back(number_in(entry + ".0", *pair->get(0), any_number),
                        number_in(entry + ".1", *pair->get(1), any_number));
  }
  return points;
}

std::optional<std::array<std::string, 3>> Table::optional_formulas(const std::string& key) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    return std::nullopt;
  return formulas_in(key, *node);
}

std::string Table::number_or_word(const std::string& key, const std::string& otherwise) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    return otherwise;
  if (node->is_string())
    return *node->value<std::string>();
  return fmt::format("{}", number_in(key, *node, any_number));
}

Table Table::table(const std::string& key) {
  const toml::node* node = declare_wanted(key);
  if (node != nullptr && !node->is_table())
    wrong_type(key, *node, "a table");
  return {*document_, node == nullptr ? nullptr : node->as_table(), path_of(key)};
}

std::optional<Table> Table::optional_table(const std::string& key) {
  const toml::node* node = declare(key);
  if (node == nullptr)
    return std::nullopt;
  if (!node->is_table())
    wrong_type(key, *node, "a table");
  return Table(*document_, node->as_table(), path_of(key));
}

std::vector<Table> Table::tables(const std::string& key) {
  const toml::node* node = declare(key);
  std::vector<Table> tables;
  if (node == nullptr)
    return tables;
  const toml::array* list = node->as_array();
  if (list == nullptr)
    wrong_type(key, *node, fmt::format("a list of tables: write [[{}]]", path_of(key)).c_str());
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string entry = fmt::format("{}.{}", key, i);
    if (!list->get(i)->is_table())
      wrong_type(entry, *list->get(i), "a table");
    tables.push_back(Table(*document_, list->get(i)->as_table(), path_of(entry)));
  }
  return tables;
}

void Table::finish() const {
  if (table_ == nullptr)
    return;
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(declared_.begin(), declared_.end(), name) == declared_.end())
      throw InputError(
          fmt::format("unknown key {}", in_quotes(path_of(name))), document_->where_key(path_of(name)),
          fmt::format("{}keys {}: {}", did_you_mean(name, declared_),
                      path_.empty() ? fmt::format("of a {}", document_->kind()) : fmt::format("in {}", path_),
                      fmt::join(declared_, ", ")));
  }
  if (!missing_.empty())
    throw InputError(fmt::format("missing key '{}'", path_of(missing_.front())), document_->where(path_),
                     fmt::format("add it: {} has no default", missing_.front()));
}

} // namespace tessera::app
